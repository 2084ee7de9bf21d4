#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bie/estimate/cost_cache.hpp"
#include "bie/estimate/cost_row.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// What measuring a cost table may take.
struct CostBudget {
  double seconds = 9.0;         ///< in which everything has to be done
  double model_seconds = 2.0;   ///< that the cost model may take of them
  double stretch_share = 0.35;  ///< of seconds or steps, kept from trial runs for stretches
  double first_trial = 2.0;     ///< seconds that the first trial run has in any case: without it there is no cost table
  /// Accepted steps of all trial runs together. They take the place of the seconds of trial runs, and the degrees and
  /// steps of the cost table are the same however fast the machine is.
  std::optional<std::int64_t> steps{};
};

/// Cost of a scene at the given tolerances, falling, in less than ten seconds; at once if the cache has it. The loosest
/// ones are run to the end, as long as the budget allows. The last of these predicts the others: from some of its
/// states stretches of a few steps are taken with the next tolerances, up to the first of the highest time order, and
/// they say how many steps take the place of one of the trial run, and of how many evaluations (take_stretches). At a
/// tolerance T of the last stretches times q a step of j sweeps is q^(1/(j + 1)) times as large, with the past of M
/// nodes continued q^(1/(j + 1 + M)) times. Where there is no time for stretches two trial runs tell: if the last took
/// N steps and the one before, with the tolerance r times as large, M, then T of its own times q takes q^(−1/k) times
/// as many, with k = ln r/ln(N/M), one more for each order more; of one alone a step with an estimated error e may be
/// (T/e)^(1/k) times as long, k being the time order. The spectrum at each step says which degree T needs, with what
/// the run itself took beyond its spectrum, and the first step with T which one it begins with; each step costs what
/// the cost model says at that degree. Degree and time order of the scene are left to each tolerance.
/// Accuracy: degrees and steps of the same budget of steps are the same on every machine
/// (tests/estimate/cost_table_test.cpp)
std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                   const CostBudget& budget = {});

}  // namespace vehd
