#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bie/runs/run_directory.hpp"
#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Files of a sweep.
struct SweepPaths {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path table() const { return directory / "table.csv"; }
  /// Keys and columns of the table, and the source of its runs.
  [[nodiscard]] std::filesystem::path description() const { return directory / "sweep.json"; }
  [[nodiscard]] std::filesystem::path runs() const { return directory / "runs"; }
  [[nodiscard]] std::filesystem::path run(const SweepRun& run) const { return runs() / run.name; }
  [[nodiscard]] std::filesystem::path slurm_script() const { return directory / "sweep.sbatch"; }
};

/// Result of a run, from which its row in the table is made.
struct RunResult {
  std::string verdict{};  ///< of the run, or "refused", or "crashed"
  std::string reason{};   ///< why it did not reach its end; empty if it did
  double seconds = 0.0;   ///< wall time; of the last session including set-up and files
  /// Last row of its history as written, by column.
  std::map<std::string, std::string, std::less<>> final_values{};
};

/// Result of a session that has written its summary, without seconds.
/// @throws InputError if the history cannot be read
RunResult result_of(const RunPaths& paths, const nlohmann::json& summary);
/// Writes result.json in the directory of a run, in one step.
/// @throws OutputError
void write_result(const std::filesystem::path& directory, const RunResult& result);
/// The content of result.json; nullopt if there is none that can be read.
std::optional<RunResult> read_result(const std::filesystem::path& directory);
/// Whether read_result finds a result.
bool has_result(const std::filesystem::path& directory);

/// Numbers of rows by the outcome of their runs.
struct SweepCount {
  std::int64_t completed = 0, stopped = 0, refused = 0, crashed = 0;
  std::int64_t unfinished = 0;  ///< running or waiting
  double seconds = 0.0;         ///< sum over all runs
};

/// Writes sweep.json and table.csv: one row for each run in the order of the sweep with its values, the requested
/// columns, verdict, reason, seconds and the name of its directory. The table depends on the results only, not on who
/// computed them or in which order. Of several simultaneous writers the last one has all results.
/// @throws OutputError
SweepCount write_sweep_table(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs);

}  // namespace vehd
