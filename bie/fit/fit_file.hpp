#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/fit/free_key.hpp"

namespace vehd {

/// Contents of a fit file.
struct FitFile {
  std::filesystem::path file;
  std::vector<FreeKey> keys;
  std::vector<Experiment> experiments;
};

/// Reads and validates a fit (docs/fit.md) with the scenes and data of its experiments. All scenes must accept both
/// ends of each key's interval.
/// @throws InputError "file:line: what is wrong, the value, what is accepted"
FitFile read_fit(const std::filesystem::path& path);
/// read_fit for text in memory.
/// @param name    stands for the file in messages
/// @param folder  where relative paths start
/// @throws InputError as read_fit
FitFile parse_fit(const std::string& text, const std::string& name, const std::filesystem::path& folder);

}  // namespace vehd
