#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Degrees to solve, and the criterion for stopping.
struct LevelPlan {
  std::string problem;  ///< as in Level
  std::vector<int> degrees;
  double tolerance;                    ///< of the linear solvers
  double target;                       ///< relative change at which to stop; 0: all degrees
  std::vector<std::string> judged_by;  ///< surface fields whose change between levels decides
};

/// Results of one level.
struct Solved {
  Cost cost;
  FieldValues surface, samples;
};

/// Solves one problem on a discretisation.
using SolveLevel = std::function<Solved(const Discretisation&, const SolveSettings&)>;

/// Level from the result of `solve` on one discretisation, with its run time, reported as "finite elements: potential,
/// degree 4, outer radius 8: 7291 unknowns, 0.8 s".
Level solve_level(const std::string& problem, const Discretisation& discretisation, double outer_radius,
                  const Report& report, const std::function<Solved(const Discretisation&)>& solve);

/// Raises the degree until the target is met. Then repeats the level two below the last one with fewer exact harmonics
/// at the outer sphere, whose effect hardly depends on the degree, and again with a larger tolerance and from zero.
/// `solve` is called for the levels first, then for these two.
LevelSequence run_levels(const LevelPlan& plan, Meshes& meshes, const Report& report, const SolveLevel& solve);

/// Initial guess of the linear solvers: the last solution, if there is one.
template <typename Solution>
const Solution* start_of(const std::vector<Solution>& before, const SolveSettings& settings) {
  return before.empty() || settings.from_zero ? nullptr : &before.back();
}

}  // namespace vehd::fem_check
