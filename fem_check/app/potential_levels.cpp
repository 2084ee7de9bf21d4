#include "fem_check/app/potential_levels.hpp"

#include "fem_check/app/comparison.hpp"
#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/sample_values.hpp"
#include "fem_check/app/vesicle_fields.hpp"

namespace vehd::fem_check {
namespace {

PotentialProblem base_problem(const std::vector<CheckInput>& inputs) {
  const Physics& physics = inputs.front().physics;
  PotentialProblem problem;
  problem.field = physics.field;
  problem.conductivity_in = number_of(inputs, &Physics::conductivity_in);
  problem.conductivity_out = physics.conductivity_out;
  problem.permittivity_in = number_of(inputs, &Physics::permittivity_in);
  problem.permittivity_out = physics.permittivity_out;
  if (inputs.front().wall) problem.wall = inputs.front().wall->field;
  return problem;
}

/// σ_i E_i − σ_e E_e.
Eigen::MatrixXd free_current(const PotentialTraces& traces, const PotentialProblem& materials,
                             const SurfacePoints& points) {
  Eigen::MatrixXd result(1, points.size());
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    result(0, i) = materials.conductivity_out * (traces.flux_in[i] - traces.charge[i]) -
                   materials.conductivity_in[points.vesicle[i]] * traces.flux_in[i];
  }
  return result;
}

}  // namespace

double tail_of_force(const PotentialLevels& potential) {
  const std::optional<Convergence> found = convergence_of(potential.sequence, "force");
  return found ? found->tail : 1.0;
}

PotentialProblem given_problem(const std::vector<CheckInput>& inputs) {
  PotentialProblem problem = base_problem(inputs);
  if (!inputs.front().charged_faces()) {
    problem.membrane =
        PrescribedJump{series_of(inputs, [](const CheckInput& input) { return input.potential; }).scalar()};
    return problem;
  }
  problem.conductivity_in = problem.permittivity_in;
  problem.conductivity_out = problem.permittivity_out;
  problem.membrane =
      ChargedMembrane{number_of(inputs, &Physics::capacitance),
                      series_of(inputs, [](const CheckInput& input) { return input.free_charge_in; }).scalar()};
  problem.current_jump = series_of(inputs, [](const CheckInput& input) {
                           return Eigen::MatrixXd(input.free_charge_in + input.free_charge_out);
                         }).scalar();
  return problem;
}

PotentialLevels solve_potential_levels(const std::vector<CheckInput>& inputs, Meshes& meshes,
                                       const Refinement& refinement, const Report& report) {
  const CheckInput& input = inputs.front();
  PotentialProblem given = given_problem(inputs), steady = base_problem(inputs);
  steady.membrane = SteadyMembrane{number_of(inputs, &Physics::conductance), 0.0};

  PotentialLevels result;
  std::vector<PotentialSolution> steady_solutions;
  const auto solve = [&](const Discretisation& discretisation, const SolveSettings& settings) {
    given.tolerance = steady.tolerance = settings.tolerance;
    given.exterior_degree = steady.exterior_degree = settings.exterior_degree;
    const SurfacePoints points = discretisation.quadrature_points(refinement.points_per_edge);
    const PotentialSolution solution = solve_potential(discretisation, given, start_of(result.solutions, settings));
    const PotentialTraces traces = solution.on_surface(points);
    Solved solved{solution.cost(),
                  {{"q", traces.charge.transpose()}, {"flux_in", traces.flux_in.transpose()}, {"force", traces.force}},
                  {}};
    if (input.charged_faces()) {
      solved.surface["Vm_of_charges"] = traces.transmembrane_potential.transpose();
      solved.surface["free_current"] = free_current(traces, steady, points);
    }
    if (input.bie.sample_potential.size() > 0) {
      solved.samples["potential"] = at_samples(discretisation, input.samples.points, [&](const VolumePoints& places) {
        return Eigen::MatrixXd(solution.potential(places).transpose());
      });
    }
    if (input.steady()) {
      steady_solutions.push_back(solve_potential(discretisation, steady, start_of(steady_solutions, settings)));
      const PotentialTraces steady_traces = steady_solutions.back().on_surface(points);
      solved.surface["Vm"] = steady_traces.transmembrane_potential.transpose();
      solved.surface["q_steady"] = steady_traces.charge.transpose();
    }
    result.solutions.push_back(solution);
    return solved;
  };
  const LevelPlan plan{"potential",
                       refinement.potential_degrees,
                       refinement.potential_tolerance,
                       refinement.potential_target,
                       {"q", "Vm", "q_steady", "Vm_of_charges"}};
  result.sequence = run_levels(plan, meshes, report, solve);
  const std::size_t n_levels = result.sequence.levels.size();
  result.solutions.erase(result.solutions.begin() + static_cast<std::ptrdiff_t>(n_levels), result.solutions.end());
  if (input.steady()) result.steady = steady_solutions[n_levels - 1];
  return result;
}

}  // namespace vehd::fem_check
