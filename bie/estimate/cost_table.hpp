#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bie/estimate/cost_cache.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// What one accuracy costs.
struct CostRow {
  double tolerance = 0.0;
  int order = 0;              ///< highest degree that the run takes
  std::int64_t steps = 0;     ///< accepted ones
  double seconds = 0.0;       ///< of `vehd run`, without pictures
  double file_seconds = 0.0;  ///< of these, what its files take
  std::int64_t memory_bytes = 0;
  bool measured = false;  ///< degree and steps are those of a whole run
  /// Why a run with this tolerance, or where there was no time for it with the last one that was tried, cannot take its
  /// steps; empty if it can. Nothing else is known then.
  std::string stops;
};

/// What measuring a cost table may take.
struct CostBudget {
  double seconds = 9.0;        ///< in which everything has to be done
  double model_seconds = 3.5;  ///< that the cost model may take of them
  double first_trial = 2.0;    ///< seconds that the first trial run has in any case: without it there is no cost table
  /// Accepted steps of all trial runs together. They take the place of the seconds of trial runs, and the degrees and
  /// steps of the cost table are the same however fast the machine is.
  std::optional<std::int64_t> steps{};
};

/// Cost of a scene at the given tolerances, falling, in less than ten seconds; at once if the cache has it. The loosest
/// ones are run to the end, as long as the budget allows. The last of these predicts the others: if it took N steps and
/// the one before, with the tolerance r times as large, M, then a tolerance T of its own times q takes q^(−1/k) times
/// as many, with k = ln r/ln(N/M), one more for each order more. Where only one was run a step with an estimated error
/// e may be (T/e)^(1/k) times as long, k being the time order. The spectrum at each step says which degree T needs,
/// with what the run itself took beyond its spectrum; each step costs what the cost model says at that degree. Degree
/// and time order of the scene are left to each tolerance.
/// Accuracy: degrees and steps of the same budget of steps are the same on every machine
/// (tests/estimate/cost_table_test.cpp)
std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                   const CostBudget& budget = {});

}  // namespace vehd
