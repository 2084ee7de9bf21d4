#include "fem_check/app/potential_levels.hpp"

#include "fem_check/app/level_loop.hpp"
#include "fem_check/app/sample_values.hpp"
#include "fem_check/app/surface_series.hpp"

namespace vehd::fem_check {
namespace {

PotentialProblem base_problem(const CheckInput& input) {
  PotentialProblem problem;
  problem.field = input.physics.field;
  problem.conductivity_in = input.physics.conductivity_in;
  problem.conductivity_out = input.physics.conductivity_out;
  problem.permittivity_in = input.physics.permittivity_in;
  problem.permittivity_out = input.physics.permittivity_out;
  return problem;
}

}  // namespace

PotentialProblem given_problem(const CheckInput& input) {
  PotentialProblem problem = base_problem(input);
  if (!input.charged_faces()) {
    problem.membrane = PrescribedJump{SurfaceSeries(input.potential).scalar()};
    return problem;
  }
  problem.conductivity_in = input.physics.permittivity_in;
  problem.conductivity_out = input.physics.permittivity_out;
  problem.membrane = ChargedMembrane{input.physics.capacitance, SurfaceSeries(input.free_charge_in).scalar()};
  problem.current_jump = SurfaceSeries(input.free_charge_in + input.free_charge_out).scalar();
  return problem;
}

PotentialLevels solve_potential_levels(const CheckInput& input, const Meshes& meshes, const Refinement& refinement,
                                       const Report& report) {
  PotentialProblem given = given_problem(input), steady = base_problem(input);
  steady.membrane = SteadyMembrane{input.physics.conductance, 0.0};

  PotentialLevels result;
  std::vector<PotentialSolution> steady_solutions;
  const auto solve = [&](const Discretisation& discretisation, double tolerance) {
    given.tolerance = steady.tolerance = tolerance;
    const SurfacePoints points = discretisation.quadrature_points(refinement.points_per_edge);
    const PotentialSolution solution = solve_potential(discretisation, given);
    const PotentialTraces traces = solution.on_surface(points);
    Solved solved{solution.cost(),
                  {{"q", traces.charge.transpose()}, {"flux_in", traces.flux_in.transpose()}, {"force", traces.force}},
                  {}};
    if (input.charged_faces()) {
      solved.surface["Vm_of_charges"] = traces.transmembrane_potential.transpose();
      solved.surface["free_current"] = (input.physics.conductivity_out * (traces.flux_in - traces.charge) -
                                        input.physics.conductivity_in * traces.flux_in)
                                           .transpose();
    }
    if (input.bie.sample_potential.size() > 0) {
      solved.samples["potential"] = at_samples(discretisation, input.samples.points, [&](const VolumePoints& places) {
        return Eigen::MatrixXd(solution.potential(places).transpose());
      });
    }
    if (input.steady()) {
      steady_solutions.push_back(solve_potential(discretisation, steady));
      const PotentialTraces steady_traces = steady_solutions.back().on_surface(points);
      solved.surface["Vm"] = steady_traces.transmembrane_potential.transpose();
      solved.surface["q_steady"] = steady_traces.charge.transpose();
    }
    result.solutions.push_back(solution);
    return solved;
  };
  const LevelPlan plan{"potential",
                       {refinement.potential_first, refinement.potential_last},
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
