#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bie/runs/run_directory.hpp"

namespace vehd {

/// How a run of a sweep came out: what its row in the table is made from.
struct RunResult {
  std::string verdict;   ///< of the run; "refused" where it could not begin
  std::string reason;    ///< why it did not reach its end; empty if it did
  double seconds = 0.0;  ///< on the clock, from opening its directory until all its files are written
  std::map<std::string, std::string, std::less<>>
      final_values;                                       ///< of the last row of its history, by column, as written
  std::map<std::string, std::string, std::less<>> units;  ///< of these columns where they have one
};

/// Of a session that has written its summary.
/// @param seconds  that its run has taken
/// @throws InputError if the history cannot be read
RunResult result_of(const RunPaths& paths, const nlohmann::json& summary, double seconds);

/// result.json of the directory, which nobody else may write to. The file is there as a whole or not at all.
/// @throws OutputError
void write_result(const std::filesystem::path& directory, const RunResult& result);
/// nullopt where there is none, or none that can be read.
std::optional<RunResult> read_result(const std::filesystem::path& directory);
/// Whether there is one.
bool has_result(const std::filesystem::path& directory);

/// Replaces a file in one step, also where processes of several machines do so at once. @throws OutputError
void replace_shared_file(const std::filesystem::path& path, const std::string& text);

}  // namespace vehd
