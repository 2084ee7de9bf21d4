#pragma once

#include <cstdint>
#include <vector>

#include "bie/runs/sweep/sweep_runs.hpp"

namespace vehd {

/// Predicted cost of the runs of a sweep.
struct SweepCost {
  std::vector<double> seconds;    ///< of each run, 0 of a scene that is refused
  std::int64_t memory_bytes = 0;  ///< most that one of them needs; 0 where that of none is known
};

/// Runs that need as many unknowns, operators and shapes a step have steps of one cost, which is measured on the first
/// of them (predict_cost); a tolerance is taken to need as many steps in the same time as there. Runs whose trial stops
/// count as an average run.
SweepCost predicted_cost(const std::vector<SweepRun>& runs);

/// Runs that belong together, longest first.
using SweepPack = std::vector<std::size_t>;

/// Shares runs out so that the packs take about as long: each run, the longest first, goes to the pack that has least.
/// @param n_packs  at least 1; packs without a run are left out
std::vector<SweepPack> packs_of(const std::vector<double>& seconds, std::size_t n_packs);

/// Fewest packs of which each is predicted to be done in that time, with room for a prediction that is too low by a
/// half; one for each run at most.
std::size_t packs_within(const std::vector<double>& seconds, double limit_seconds);

}  // namespace vehd
