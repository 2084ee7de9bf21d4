#pragma once

#include <cstdint>
#include <vector>

#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Predicted cost of the runs of a sweep.
struct SweepCost {
  std::vector<double> seconds;    ///< of each run; 0 if its scene is refused
  std::int64_t memory_bytes = 0;  ///< largest need of a run; 0 if unknown for all
};

/// Runs with equal symmetry, tolerance, unknowns, operators and shapes per step have one cost per step, which
/// predict_cost measures on the first of them. With a tolerance they are assumed to take equally many steps per unit of
/// time. A run whose trial stops counts as an average run.
SweepCost predicted_cost(const std::vector<SweepRun>& runs);

/// Indices of the runs of one pack, longest first.
using SweepPack = std::vector<std::size_t>;

/// Distributes runs over packs of similar duration: each run, longest first, goes to the pack with the smallest load.
/// @param n_packs  at least 1; packs without a run are left out
std::vector<SweepPack> packs_of(const std::vector<double>& seconds, std::size_t n_packs);

/// Fewest packs that are each predicted to finish within the limit, with a margin of a factor 1.5 for low predictions;
/// at most one for each run.
std::size_t packs_within(const std::vector<double>& seconds, double limit_seconds);

}  // namespace vehd
