#pragma once

#include <filesystem>
#include <random>
#include <string>

/// A damage of the folder of a run: a file with a bit flipped, cut or removed; rows of a table removed, exchanged or
/// edited; datasets renamed, removed or given other values, attributes altered; a summary.json edited.
struct RunDamage {
  std::filesystem::path file;
  std::string what;  ///< description of the damage
};

/// Damages a file of the folder at a place that the generator chooses.
RunDamage damage_run(const std::filesystem::path& folder, std::mt19937& random);
