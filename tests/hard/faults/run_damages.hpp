#pragma once

#include <filesystem>
#include <random>
#include <string>

/// One damage to a folder of a run: a file with a bit flipped, cut or gone; rows of a table removed, exchanged or
/// edited; datasets renamed, removed or with other values, attributes altered; a summary.json edited.
struct RunDamage {
  std::filesystem::path file;
  std::string what;  ///< that was done to it
};

/// Damages a file of the folder at a place that the generator chooses.
RunDamage damage_run(const std::filesystem::path& folder, std::mt19937& random);
