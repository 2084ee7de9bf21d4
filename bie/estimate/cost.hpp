#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bie/estimate/plan.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Predicted cost of a run with one tolerance.
struct CostRow {
  double tolerance = 0.0;
  int order = 0;              ///< highest degree that the run takes
  std::int64_t steps = 0;     ///< accepted ones
  double seconds = 0.0;       ///< of `vehd run`, without pictures
  double file_seconds = 0.0;  ///< of these, for its files
  std::int64_t memory_bytes = 0;
  bool measured = false;  ///< the trial run has this tolerance and reached the end of the scene
  std::string stops{};    ///< why a trial run with this tolerance stopped; nothing is predicted then
  std::string unknown{};  ///< why nothing is predicted although nothing stopped; empty otherwise
};

/// Limits of a prediction.
struct CostBudget {
  double seconds = 9.0;  ///< for everything; then the current trial is abandoned
  /// Accepted steps of the trial run. If this limit is the one that ends it, degrees and steps of the predictions are
  /// the same on every machine.
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();
};

/// Predicted cost of a scene at falling tolerances. Degree and time order are those of each tolerance, but those of the
/// scene for its own.
///
/// A trial run with the loosest tolerance T0 that can be stepped goes to the end of the scene or, if the budget ends
/// before, as far as it comes; the rest is then expected to pass as its later half did. From its number of steps N0 and
/// its highest degree p0, a run with the tolerance T takes N0 (T0/T)^(1/k) steps, k being the highest time order, and
/// the degree p0 + 4 log10(T0/T) (6 for 4 if p0 is the highest that T0 allows), at most default_order(T). Steps make as
/// many evaluations as those of the trial run; their time grows with the degree as that of steps from the start of the
/// scene, which are timed, or like p^3.5 and memory like p^4 where there is no time for that.
///
/// Accuracy: nine of ten rows of the shipped scenes within a factor of 3 (docs/digits.md; steps in
/// tests/estimate/cost_test.cpp)
/// @throws InputError if the shape file of the scene cannot be used
std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances,
                                   const CostBudget& budget = {});

/// Adds steps, seconds per step and memory to a plan of the scene. With a tolerance they are those of cost_table_of for
/// a trial run with the tolerance 0.01. Fixed steps are timed at the degree of the scene; if there is no time for that,
/// at lower degrees, from which seconds grow like p^3.5 and memory like p^4. That a lower degree or a looser tolerance
/// cannot be stepped says nothing of the run.
void predict_cost(const Scene& scene, RunPlan& plan, const CostBudget& budget = {});

}  // namespace vehd
