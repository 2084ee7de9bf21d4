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
    const auto start = std::chrono::steady_clock::now();
    const FlowSolution solution = solve_flow(discretisation, problem);
    const FlowTraces traces = solution.on_surface(discretisation.quadrature_points(refinement.points_per_edge));
    FieldValues samples;
    if (input.bie.sample_velocity.size() > 0) {
      samples["velocity"] = solution.velocity(discretisation.locate(input.samples.points));
    }
    result.solutions.push_back(solution);
    Level level = level_of("flow", discretisation, solution.cost(), start);
    level.surface = {{"velocity", traces.velocity}, {"divergence", traces.divergence.transpose()}};
    level.samples = std::move(samples);
    return level;
  };
  const LevelPlan plan{{refinement.flow_first, refinement.flow_last}, refinement.flow_target, {"velocity"}};
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
    const auto start = std::chrono::steady_clock::now();
    const PotentialSolution& electric = potential.solutions[potential.solutions.size() - 1 - back];
    problem.force = [&](const SurfacePoints& at) { return Vectors(given(at) - electric.on_surface(at).force); };
    const FlowSolution change = solve_flow(discretisation, problem);
    Level& level = sequence.levels[last - back];
    const Vectors velocity = change.on_surface(points).velocity;
    level.surface["velocity_own_force"] = level.surface.at("velocity") + velocity;
    if (back == 0) {
      for (Level* other : {&sequence.far, &sequence.levels[sequence.repeated]}) {
        other->surface["velocity_own_force"] = other->surface.at("velocity") + velocity;
      }
    }
    Level step = level_of("flow by the change of f_E", discretisation, change.cost(), start);
    step.outer_radius = meshes.outer_radius();
    report(level_line(step));
  }
}

}  // namespace vehd::fem_check
