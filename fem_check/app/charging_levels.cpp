#include "fem_check/app/charging_levels.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>
#include <vector>

#include "fem_check/app/charging_run.hpp"

namespace vehd::fem_check {

ChargingLevels solve_charging_levels(const CheckInput& input, Meshes& meshes, const Refinement& refinement,
                                     const Report& report) {
  const int fewest_steps = input.in_time->fewest_steps, most_steps = input.in_time->intervals / 3;
  const ChargingRun run(input, refinement);
  const ShapePath whole_path(*input.in_time);
  const ShapePath* path = input.in_time->moves() ? &whole_path : nullptr;
  const LevelPlan plan{charging_problem,
                       refinement.potential_degrees,
                       refinement.potential_tolerance,
                       refinement.charging_target,
                       {"Vm"}};
  ChargingLevels result;
  result.sequence = run_levels(plan, meshes, report, [&](const Discretisation& space, const SolveSettings& settings) {
    return run.solve(space, {fewest_steps, settings, path});
  });

  // V_m at the points of the comparison.
  const auto refined = [&](int degree, int steps, const ShapePath* along) {
    const auto solve = [&](const Discretisation& space) {
      return run.solve(space, {.steps = steps, .settings = {refinement.potential_tolerance}, .path = along});
    };
    const std::string name = fmt::format("{} in {} steps", charging_problem, steps);
    return solve_level(name, meshes.discretise(degree), meshes.outer_radius(), report, solve).surface.at("Vm");
  };
  const std::vector<Level>& levels = result.sequence.levels;
  const Eigen::MatrixXd lowest = levels[0].surface.at("Vm"), next = levels[1].surface.at("Vm");
  const int degree = levels[0].degree;
  result.steps = 2 * fewest_steps;
  Eigen::MatrixXd finest = refined(degree, result.steps, path), change = finest - lowest;
  // Errors of the change by more steps: that of the lowest degree, from the first doubling, and that of the path
  // between the snapshots.
  Eigen::MatrixXd further = (refined(levels[1].degree, result.steps, path) - next - change).cwiseAbs();
  if (path != nullptr) {
    const ShapePath coarser = path->coarser();
    further += (refined(degree, fewest_steps, &coarser) - lowest).cwiseAbs();
  }
  const double enough = refinement.charging_target * levels.back().surface.at("Vm").norm();
  while ((change.norm() > enough || !result.order_in_time) && 2 * result.steps <= most_steps) {
    result.steps *= 2;
    const Eigen::MatrixXd before = std::exchange(finest, refined(degree, result.steps, path));
    const double former = change.norm();
    change = finest - before;
    if (!(change.norm() > 0.0)) break;
    result.order_in_time = std::log2(former / change.norm());
  }
  result.time_error = change.cwiseAbs() + further;
  const Eigen::MatrixXd added = finest - lowest;
  LevelSequence& sequence = result.sequence;
  for (Level& level : sequence.levels) level.surface.at("Vm") += added;
  for (Level* level : {&sequence.truncated, &sequence.loose}) level->surface.at("Vm") += added;
  return result;
}

}  // namespace vehd::fem_check
