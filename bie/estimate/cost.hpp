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
  int order = 0;              ///< highest degree of the run
  std::int64_t steps = 0;     ///< accepted steps
  double seconds = 0.0;       ///< of `vehd run`, without pictures
  double file_seconds = 0.0;  ///< of these, for its files
  std::int64_t memory_bytes = 0;
  bool measured = false;  ///< the trial run has this tolerance and reached the end of the scene
  std::string stops{};    ///< why a trial run with this tolerance stopped; nothing is predicted then
  std::string unknown{};  ///< why nothing is predicted although nothing stopped; empty otherwise
};

/// Limits of a prediction.
struct CostBudget {
  double seconds = 9.0;  ///< for the whole prediction; then the current trial is abandoned
  /// Accepted steps of the trial run. If this limit ends the trial, predicted degrees and steps are the same on every
  /// machine.
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();
};

/// Predicted cost of a scene at falling tolerances. Degree and time order follow from each tolerance; at the scene's
/// own tolerance they are those of the scene.
///
/// A trial run with the loosest tolerance T0 at which steps succeed goes to the end of the scene, or as far as the
/// budget allows; the remaining steps are then assumed to be like those of its later half. From its number of steps N0
/// and its highest degree p0, a run with the tolerance T takes N0 (T0/T)^(1/k) steps, where k is the highest time
/// order, and the degree p0 + 4 log10(T0/T) (6 instead of 4 if p0 is the highest that T0 allows), at most the highest
/// that T allows. A step makes as many evaluations as in the trial run. Their time grows with the degree like that of
/// timed steps from the start of the scene. If there is no time for timing, it grows like p^3.5, and memory like p^4.
///
/// Accuracy: nine of ten rows of the shipped scenes within a factor of 3 (docs/digits.md; steps in
/// tests/estimate/cost_test.cpp)
/// @throws InputError if the shape file of the scene cannot be used
std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances,
                                   const CostBudget& budget = {});

/// Adds steps, seconds per step and memory to a plan of the scene. With a tolerance they are those of cost_table_of for
/// a trial run with the tolerance 0.01, or the scene's own if that is looser. Fixed steps are timed at the degree of
/// the scene or, without time for that, at lower degrees; seconds then grow like p^3.5 and memory like p^4. A step that
/// fails at a lower degree or looser tolerance does not count against the run.
void predict_cost(const Scene& scene, RunPlan& plan, const CostBudget& budget = {});

}  // namespace vehd
