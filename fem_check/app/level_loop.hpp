#pragma once

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

struct LevelPlan {
  DegreeRange degrees;
  double target;                       ///< 0: all degrees
  std::vector<std::string> judged_by;  ///< surface fields whose change from level to level decides
};

/// Largest relative change of the judged fields between two levels, root mean square over the points.
double largest_change(const Level& a, const Level& b, const std::vector<std::string>& fields);

/// Level of one solve, without its fields. Seconds are those since `start`.
Level level_of(const std::string& problem, const Discretisation& discretisation, const Cost& cost,
               std::chrono::steady_clock::time_point start);

/// "finite elements: potential, degree 4, outer radius 8: 7291 unknowns, 0.8 s".
std::string level_line(const Level& level);

/// Raises the degree until the target is met, then repeats a level with the outer sphere further out: one two degrees
/// below the last, as the change has little to do with the degree.
/// @param solve  (discretisation) → Level
template <typename Solve>
LevelSequence run_levels(const LevelPlan& plan, const Meshes& meshes, const Report& report, const Solve& solve) {
  // An observed order takes three levels.
  constexpr std::size_t fewest = 3;
  LevelSequence result;
  auto& levels = result.levels;
  for (int degree = plan.degrees.first; degree <= plan.degrees.last; ++degree) {
    levels.push_back(solve(meshes.discretise(degree)));
    levels.back().outer_radius = meshes.outer_radius();
    report(level_line(levels.back()));
    if (levels.size() < fewest) continue;
    // The change is the error of the level before; this one's is smaller by the factor of the last step.
    const double before = largest_change(levels[levels.size() - 3], levels[levels.size() - 2], plan.judged_by);
    const double change = largest_change(levels[levels.size() - 2], levels.back(), plan.judged_by);
    if (change * std::min(1.0, change / before) <= plan.target) break;
  }
  result.repeated = static_cast<int>(levels.size() - fewest);
  result.far = solve(meshes.discretise_far(levels[result.repeated].degree));
  result.far.outer_radius = meshes.far_outer_radius();
  report(level_line(result.far));
  return result;
}

}  // namespace vehd::fem_check
