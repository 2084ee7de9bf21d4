#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Files of a sweep.
struct SweepPaths {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path table() const { return directory / "table.csv"; }
  /// What the table shows: keys, columns, and the folders of the runs.
  [[nodiscard]] std::filesystem::path description() const { return directory / "sweep.json"; }
  [[nodiscard]] std::filesystem::path runs() const { return directory / "runs"; }
  /// What each member of an array of jobs begins with.
  [[nodiscard]] std::filesystem::path packs() const { return directory / "packs.json"; }
  [[nodiscard]] std::filesystem::path slurm_script() const { return directory / "sweep.sbatch"; }
};

/// Rows of a table by how their runs came out.
struct SweepCount {
  std::int64_t completed = 0, stopped = 0, refused = 0, crashed = 0;
  std::int64_t unfinished = 0;  ///< somebody is at them, or nobody yet
  double seconds = 0.0;         ///< of all runs together

  [[nodiscard]] std::int64_t finished() const { return completed + stopped + refused + crashed; }
};

/// Writes table.csv: one row for each run in the order of the sweep, its values, the columns asked for, verdict,
/// reason, seconds and the name of its directory; and sweep.json. What it says follows from the results alone, whoever
/// computed them and in which order. Of several writers at once the last one has all.
/// @throws OutputError
SweepCount write_sweep_table(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs);

}  // namespace vehd
