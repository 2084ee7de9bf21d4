#include "fem_check/app/flow_levels.hpp"

#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

FlowProblem problem_of(const CheckInput& input, const Refinement& refinement) {
  FlowProblem problem;
  problem.viscosity_in = input.physics.viscosity_in;
  problem.viscosity_out = input.physics.viscosity_out;
  problem.tolerance = refinement.flow_tolerance;
  return problem;
}

}  // namespace

FlowLevels solve_flow_levels(const CheckInput& input, const Meshes& meshes, const Refinement& refinement,
                             const Report& report) {
  FlowProblem problem = problem_of(input, refinement);
  problem.gradient = input.physics.flow_gradient;
  const SurfaceSeries force(input.force);
  problem.force = [&](const SurfacePoints& points) { return Vectors(force(points)); };

  FlowLevels result;
  const auto solve = [&](const Discretisation& discretisation) {
    const FlowSolution solution = solve_flow(discretisation, problem);
    const FlowTraces traces = solution.on_surface(discretisation.quadrature_points(refinement.points_per_edge));
    Solved solved{solution.cost(), {{"velocity", traces.velocity}, {"divergence", traces.divergence.transpose()}}, {}};
    if (input.bie.sample_velocity.size() > 0) {
      solved.samples["velocity"] = solution.velocity(discretisation.locate(input.samples.points));
    }
    result.solutions.push_back(solution);
    return solved;
  };
  const LevelPlan plan{"flow", {refinement.flow_first, refinement.flow_last}, refinement.flow_target, {"velocity"}};
  result.sequence = run_levels(plan, meshes, report, solve);
  result.solutions.pop_back();  // the one with the outer sphere further out
  return result;
}

void add_own_force(const CheckInput& input, const Meshes& meshes, const Refinement& refinement,
                   const PotentialLevels& potential, LevelSequence& sequence, const Report& report) {
  const std::size_t last = sequence.levels.size() - 1;
  const Discretisation discretisation = meshes.discretise(sequence.levels[sequence.repeated].degree);
  const SurfacePoints points = discretisation.quadrature_points(refinement.points_per_edge);
  const SurfaceSeries given(input.force_electric);
  FlowProblem problem = problem_of(input, refinement);
  for (std::size_t back = 0; back < 2; ++back) {
    const PotentialSolution& electric = potential.solutions[potential.solutions.size() - 1 - back];
    problem.force = [&](const SurfacePoints& at) { return Vectors(given(at) - electric.on_surface(at).force); };
    const Level change = solve_level(
        "flow by the change of f_E", discretisation, meshes.outer_radius(), report, [&](const Discretisation& space) {
          const FlowSolution solution = solve_flow(space, problem);
          return Solved{solution.cost(), {{"velocity", solution.on_surface(points).velocity}}, {}};
        });
    const Eigen::MatrixXd& velocity = change.surface.at("velocity");
    Level& level = sequence.levels[last - back];
    level.surface["velocity_own_force"] = level.surface.at("velocity") + velocity;
    if (back == 0) {
      for (Level* other : {&sequence.far, &sequence.levels[sequence.repeated]}) {
        other->surface["velocity_own_force"] = other->surface.at("velocity") + velocity;
      }
    }
  }
}

}  // namespace vehd::fem_check
