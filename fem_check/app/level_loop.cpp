#include "fem_check/app/level_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <limits>

namespace vehd::fem_check {
namespace {

/// Largest relative change of the judged fields between two levels, root mean square over the points.
double largest_change(const Level& a, const Level& b, const std::vector<std::string>& fields) {
  double largest = 0.0;
  for (const std::string& name : fields) {
    const auto found = b.surface.find(name);
    if (found == b.surface.end()) continue;
    const double size = std::max(found->second.norm(), std::numeric_limits<double>::min());
    largest = std::max(largest, (a.surface.at(name) - found->second).norm() / size);
  }
  return largest;
}

}  // namespace

Level solve_level(const std::string& problem, const Discretisation& discretisation, double outer_radius,
                  const Report& report, const std::function<Solved(const Discretisation&)>& solve) {
  const auto start = std::chrono::steady_clock::now();
  Solved solved = solve(discretisation);
  Level level;
  level.problem = problem;
  level.degree = discretisation.degree();
  level.outer_radius = outer_radius;
  level.n_cells = discretisation.n_cells();
  level.n_unknowns = solved.cost.n_unknowns;
  level.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  level.peak_memory_bytes = solved.cost.peak_memory_bytes;
  level.surface = std::move(solved.surface);
  level.samples = std::move(solved.samples);
  report(fmt::format("finite elements: {}, degree {}, outer radius {:.3g}: {} unknowns, {:.1f} s", problem,
                     level.degree, outer_radius, level.n_unknowns, level.seconds));
  return level;
}

LevelSequence run_levels(const LevelPlan& plan, Meshes& meshes, const Report& report, const SolveLevel& solve) {
  const auto solve_level_with = [&](const std::string& problem, int degree, const SolveSettings& settings) {
    return solve_level(problem, meshes.discretise(degree), meshes.outer_radius(), report,
                       [&](const Discretisation& discretisation) { return solve(discretisation, settings); });
  };
  // Three levels are needed for an observed order.
  constexpr std::size_t fewest = 3;
  LevelSequence result;
  result.tolerance = plan.tolerance;
  auto& levels = result.levels;
  for (const int degree : plan.degrees) {
    levels.push_back(solve_level_with(plan.problem, degree, {plan.tolerance}));
    if (levels.size() < fewest) continue;
    if (largest_change(levels[levels.size() - 2], levels.back(), plan.judged_by) <= plan.target) break;
  }
  result.repeated = static_cast<int>(levels.size() - fewest);
  const int degree = levels[static_cast<std::size_t>(result.repeated)].degree;
  result.truncated = solve_level_with(plan.problem + " with fewer harmonics outside", degree,
                                      {plan.tolerance, truncated_exterior_degree});
  result.loose = solve_level_with(plan.problem + " with a looser solver tolerance", degree,
                                  {.tolerance = loose_factor * plan.tolerance, .from_zero = true});
  return result;
}

}  // namespace vehd::fem_check
