#pragma once

#include <functional>
#include <string>
#include <vector>

#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// Which degrees are solved, and when that is enough.
struct LevelPlan {
  std::string problem;  ///< as in Level
  std::vector<int> degrees;
  double tolerance;                    ///< of the linear solvers
  double target;                       ///< 0: all degrees
  std::vector<std::string> judged_by;  ///< surface fields whose change from level to level decides
};

/// Results of one level.
struct Solved {
  Cost cost;
  FieldValues surface, samples;
};

/// Solves on one discretisation.
using SolveLevel = std::function<Solved(const Discretisation&, const SolveSettings&)>;

/// Level of what `solve` gives on one discretisation, with the seconds that it took, reported as "finite elements:
/// potential, degree 4, outer radius 8: 7291 unknowns, 0.8 s".
Level solve_level(const std::string& problem, const Discretisation& discretisation, double outer_radius,
                  const Report& report, const std::function<Solved(const Discretisation&)>& solve);

/// Raises the degree until the target is met, then repeats a level with fewer harmonics exact at the outer sphere: one
/// two degrees below the last, as the change has little to do with the degree. The same once more with a coarser
/// tolerance, from zero. `solve` is called for the levels first, then for these two.
LevelSequence run_levels(const LevelPlan& plan, Meshes& meshes, const Report& report, const SolveLevel& solve);

/// Start of the linear solvers: the last solution, if there is one.
template <typename Solution>
const Solution* start_of(const std::vector<Solution>& before, const SolveSettings& settings) {
  return before.empty() || settings.from_zero ? nullptr : &before.back();
}

}  // namespace vehd::fem_check
