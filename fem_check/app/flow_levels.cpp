#include "fem_check/app/flow_levels.hpp"

#include <utility>

#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/sample_values.hpp"
#include "fem_check/app/vesicle_fields.hpp"

namespace vehd::fem_check {

FlowLevels solve_flow_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                             const Refinement& refinement, const Report& report) {
  const CheckInput& input = inputs.front();
  FlowProblem problem = setups.problem();
  problem.gradient = input.physics.flow_gradient;
  const SurfaceSeries force = series_of(inputs, [](const CheckInput& of) { return of.force; });
  problem.force = [&](const SurfacePoints& points) { return Vectors(force(points)); };

  FlowLevels result;
  const auto solve = [&](const Discretisation& discretisation, const SolveSettings& settings) {
    problem.tolerance = settings.tolerance;
    problem.exterior_degree = settings.exterior_degree;
    const FlowSolution solution = solve_flow(setups.at(discretisation), problem, start_of(result.solutions, settings));
    const FlowTraces traces = solution.on_surface(discretisation.quadrature_points(refinement.points_per_edge));
    Solved solved{solution.cost(), {{"velocity", traces.velocity}, {"divergence", traces.divergence.transpose()}}, {}};
    if (input.bie.sample_velocity.size() > 0) {
      solved.samples["velocity"] = at_samples(discretisation, input.samples.points, [&](const VolumePoints& places) {
        return Eigen::MatrixXd(solution.velocity(places));
      });
    }
    result.solutions.push_back(solution);
    return solved;
  };
  const LevelPlan plan{
      "flow", refinement.flow_degrees, refinement.flow_tolerance, refinement.flow_target, {"velocity"}};
  result.sequence = run_levels(plan, meshes, report, solve);
  result.solutions.erase(result.solutions.begin() + static_cast<std::ptrdiff_t>(result.sequence.levels.size()),
                         result.solutions.end());
  return result;
}

void add_own_force(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                   const Refinement& refinement, const PotentialLevels& potential, LevelSequence& sequence,
                   const Report& report) {
  // An error below this fraction of the flow's own error is negligible.
  constexpr double negligible_share = 0.25;
  Level &last = sequence.levels.back(), &before = sequence.levels[sequence.levels.size() - 2];
  const SurfaceSeries given = series_of(inputs, [](const CheckInput& input) { return input.stored.force_electric; });
  const PotentialSolution &electric = potential.solutions.back(),
                          &electric_before = potential.solutions[potential.solutions.size() - 2];
  FlowProblem problem = setups.problem();
  // Larger tolerance, since this flow is small compared with the one to which it is added.
  problem.tolerance = std::max(refinement.flow_tolerance, tolerance_of_changes);
  // On γ, without a background flow.
  const auto velocity_by = [&](int degree, const VectorOnSurface& force) {
    problem.force = force;
    const auto solve = [&](const Discretisation& space) {
      const FlowSolution solution = solve_flow(setups.at(space), problem);
      const SurfacePoints points = space.quadrature_points(refinement.points_per_edge);
      return Solved{solution.cost(), {{"velocity", solution.on_surface(points).velocity}}, {}};
    };
    return solve_level("flow by the change of f_E", meshes.discretise(degree), meshes.outer_radius(), report, solve)
        .surface.at("velocity");
  };
  // f = … − f_E: replaces the snapshot's f_E by that of the elements.
  const VectorOnSurface change = [&](const SurfacePoints& at) {
    return Vectors(given(at) - electric.on_surface(at).force);
  };
  const double tail = tail_of_force(potential);
  const VectorOnSurface electric_change = [&](const SurfacePoints& at) {
    return Vectors(tail * (electric.on_surface(at).force - electric_before.on_surface(at).force));
  };
  const int first = sequence.levels.front().degree;
  const double enough = negligible_share * (last.surface.at("velocity") - before.surface.at("velocity")).norm();
  Eigen::MatrixXd coarse = velocity_by(first, change), fine = coarse;
  for (int degree = first + 1; degree <= last.degree; ++degree) {
    coarse = std::exchange(fine, velocity_by(degree, change));
    if ((fine - coarse).norm() <= enough) break;
  }
  // The difference of the two levels includes all errors: of the flow, of the change and of f_E.
  last.surface["velocity_own_force"] = last.surface.at("velocity") + fine;
  before.surface["velocity_own_force"] = before.surface.at("velocity") + coarse + velocity_by(first, electric_change);
  Level& repeated = sequence.levels[static_cast<std::size_t>(sequence.repeated)];
  for (Level* level : {&sequence.truncated, &sequence.loose, &repeated}) {
    level->surface["velocity_own_force"] = level->surface.at("velocity") + fine;
  }
}

}  // namespace vehd::fem_check
