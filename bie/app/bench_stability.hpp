#pragma once

#include <filesystem>
#include <vector>

#include "bie/app/bench_result.hpp"
#include "bie/app/interruption.hpp"

namespace vehd {

struct StabilityTask {
  std::vector<std::filesystem::path> scenes;  ///< with their criteria, see StabilityCase
  BenchOutput output;                         ///< each run has a folder of its own below `runs`, always a fresh one
  bool brief = false;                         ///< the short form of every case
};

struct StabilityOutcome {
  BenchResult result;
  int n_failed = 0;
};

/// Runs every case as `vehd run` would and prints, for each, the criterion that came closest to its bound.
/// @throws InputError for a scene or criterion that cannot be read
StabilityOutcome bench_stability(const StabilityTask& task, Interruption& interruption);

}  // namespace vehd
