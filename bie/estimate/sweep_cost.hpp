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

}  // namespace vehd
