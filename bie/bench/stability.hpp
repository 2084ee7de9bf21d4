#pragma once

#include <filesystem>
#include <vector>

#include "bie/bench/result.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// Which hard cases are run, and where their files go.
struct StabilityTask {
  std::vector<std::filesystem::path> scenes;  ///< with their criteria, see StabilityCase
  /// Each run has a folder of its own below `runs`, always a fresh one; its first and last shape go to shapes/NAME.png.
  BenchOutput output;
  bool brief = false;  ///< the short form of every case
};

/// Outcome of the cases.
struct StabilityOutcome {
  BenchResult result;
  int n_failed = 0;
};

/// Draws the shapes of one case, small, in a folder.
/// @param paths  of its run, in a folder with the name of the case
/// @return the picture
/// @throws InputError if the run cannot be read or gnuplot is missing
std::filesystem::path draw_case(const RunPaths& paths, const std::filesystem::path& folder);

/// Runs every case as `vehd run` would and prints, for each, the criterion that came closest to its bound. Further
/// tables are for the pages: "pictures" with the shapes, which they look for in images/hard_cases, "families" with one
/// row for each family, and "faults" with the cases whose verdict names a fault.
/// @throws InputError for a scene or criterion that cannot be read, Interrupted
StabilityOutcome bench_stability(const StabilityTask& task, Interruption& interruption, BenchObserver& observer);

}  // namespace vehd
