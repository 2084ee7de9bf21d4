#include "fem_check/potential.hpp"

#include <cmath>
#include <string>

#include "fem_check/scalar_system.hpp"

namespace vehd::fem_check {

/// Inside the unknown is φ itself, outside the disturbance ψ = φ + E_∞·x: a field that is nearly zero inside a good
/// conductor, and the far field, are then not differences of large discrete numbers.
struct PotentialSolution::Data {
  std::shared_ptr<const Space> space;
  PotentialProblem problem;
  dealii::Vector<double> nodal;
  Vector voltage;  ///< V_m at the nodes of γ, L2 projection
  Vector current;  ///< σ_i ∂φ_i/∂n at the nodes of γ, L2 projection of the residual of the inner side
  Cost cost;
};

namespace {

using PotentialData = PotentialSolution::Data;

void require(bool condition, const std::string& what) {
  if (!condition) throw std::invalid_argument(what);
}

void require_valid(const PotentialProblem& problem) {
  for (const double sigma : {problem.conductivity_in, problem.conductivity_out}) {
    require(sigma > 0.0, "conductivity is " + std::to_string(sigma) + "; must be positive");
  }
  if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
    require(bool(prescribed->potential_jump), "the prescribed transmembrane potential is missing");
  } else if (const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane)) {
    require(steady->conductance >= 0.0, "membrane conductance is negative");
  } else {
    const auto& charging = std::get<ChargingMembrane>(problem.membrane);
    require(charging.capacitance > 0.0, "membrane capacitance must be positive");
    require(charging.conductance >= 0.0, "membrane conductance is negative");
    require(charging.time_step > 0.0 && charging.steps >= 1, "charging takes a positive time step and number of steps");
    require(bool(charging.initial), "the initial transmembrane potential is missing");
  }
}

/// Coefficient of [[u]][[w]] on γ.
double membrane_coefficient(const PotentialProblem& problem) {
  if (const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane)) return steady->conductance;
  if (const auto* charging = std::get_if<ChargingMembrane>(&problem.membrane)) {
    return charging->conductance + charging->capacitance / charging->time_step;
  }
  return 0.0;
}

bool mean_is_free(const PotentialProblem& problem) {
  const auto* steady = std::get_if<SteadyMembrane>(&problem.membrane);
  return steady != nullptr && steady->conductance == 0.0;
}

/// Homogeneous constraints: coincident nodes tied, outer values fixed, one inner value fixed where they float.
Constraints make_constraints(const Space& space, const PotentialProblem& problem,
                             const std::vector<DofIndex>& outer_dofs) {
  const auto& pairs = space.trace->pairs().pairs;
  Constraints constraints;
  constraints.reinit(dealii::complete_index_set(space.dofs.n_dofs()));
  if (std::holds_alternative<PrescribedJump>(problem.membrane)) {
    for (const auto& [inner, outer] : pairs) {
      constraints.add_line(inner);
      constraints.add_entry(inner, outer, 1.0);
    }
  }
  if (problem.outer.kind == OuterCondition::Kind::dirichlet) {
    for (const DofIndex dof : outer_dofs) constraints.add_line(dof);
  }
  if (mean_is_free(problem)) constraints.add_line(pairs.front()[0]);
  constraints.close();
  return constraints;
}

struct OuterNodes {
  std::vector<DofIndex> dofs;
  std::vector<Vector3> positions;
};

OuterNodes outer_nodes(const Space& space) {
  OuterNodes result;
  std::vector<bool> seen(space.dofs.n_dofs(), false);
  dealii::FEValues<3> fe(space.mapping, space.element, dealii::Quadrature<3>(space.element.get_unit_support_points()),
                         dealii::update_quadrature_points);
  std::vector<DofIndex> dofs(fe.dofs_per_cell);
  for (const OuterFace& outer : space.outer) {
    const auto cell = space.cell(outer.cell);
    fe.reinit(cell);
    cell->get_dof_indices(dofs);
    for (unsigned i = 0; i < dofs.size(); ++i) {
      if (seen[dofs[i]] || !space.element.has_support_on_face(i, outer.face)) continue;
      seen[dofs[i]] = true;
      result.dofs.push_back(dofs[i]);
      const auto& x = fe.quadrature_point(i);
      result.positions.emplace_back(x[0], x[1], x[2]);
    }
  }
  return result;
}

/// u with the given jump on γ and the given values on the outer sphere, zero at all other nodes.
dealii::Vector<double> lifting(const Space& space, const PotentialProblem& problem, const OuterNodes& outer) {
  dealii::Vector<double> result(space.dofs.n_dofs());
  const MembraneTrace& trace = *space.trace;
  if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
    const Vector jump = prescribed->potential_jump(trace.nodes()) - trace.nodes().position.transpose() * problem.field;
    for (Eigen::Index p = 0; p < trace.size(); ++p) result[trace.pairs().pairs[p][0]] = jump[p];
  }
  if (problem.outer.kind == OuterCondition::Kind::dirichlet && problem.outer.value) {
    for (std::size_t i = 0; i < outer.dofs.size(); ++i) result[outer.dofs[i]] = problem.outer.value(outer.positions[i]);
  }
  return result;
}

/// φ_i − ψ_e at the nodes of γ.
Vector sheet_difference(const Space& space, const dealii::Vector<double>& nodal) {
  const auto& pairs = space.trace->pairs().pairs;
  Vector result(space.trace->size());
  for (std::size_t p = 0; p < pairs.size(); ++p) result[p] = nodal[pairs[p][0]] - nodal[pairs[p][1]];
  return result;
}

/// V_m = φ_i − ψ_e + E_∞·x.
Vector membrane_voltage(const PotentialData& data, const SurfacePoints& points) {
  return data.space->trace->evaluate(sheet_difference(*data.space, data.nodal), points) +
         points.position.transpose() * data.problem.field;
}

/// Makes the mean of V_m what it shall be by a constant inside.
void shift_to_mean(PotentialData& data, double mean) {
  const SurfacePoints& rule = data.space->trace->rule();
  const double shift = mean - rule.weight.dot(membrane_voltage(data, rule)) / rule.weight.sum();
  std::vector<bool> inner(data.nodal.size(), false);
  std::vector<DofIndex> dofs(data.space->element.n_dofs_per_cell());
  for (const auto& cell : data.space->dofs.active_cell_iterators()) {
    if (!data.space->inside(static_cast<unsigned>(cell->index()))) continue;
    cell->get_dof_indices(dofs);
    for (const DofIndex dof : dofs) inner[dof] = true;
  }
  for (DofIndex dof = 0; dof < inner.size(); ++dof) {
    if (inner[dof]) data.nodal[dof] += shift;
  }
}

}  // namespace

PotentialSolution solve_potential(const Discretisation& discretisation, const PotentialProblem& problem) {
  require_valid(problem);
  const auto data = std::make_shared<PotentialData>();
  data->space = discretisation.space();
  data->problem = problem;
  const Space& space = *data->space;
  const MembraneTrace& trace = *space.trace;
  const SurfacePoints& rule = trace.rule();
  Stopwatch watch;

  const OuterNodes outer = outer_nodes(space);
  const Constraints constraints = make_constraints(space, problem, outer.dofs);
  const bool radiates = problem.outer.kind == OuterCondition::Kind::radiation;
  const double membrane = membrane_coefficient(problem);
  const ScalarForm form{problem.conductivity_in, problem.conductivity_out, membrane,
                        radiates ? 2.0 * problem.conductivity_out / space.mesh->outer_radius() : 0.0};
  const ScalarSystem system(space, constraints, form);

  // Data of every step: ∫_γ (c − σ_e E·n) w_e − ∫_γ g E·x [[w]] + outer terms, g the coefficient of [[u]][[w]].
  Vector current_data = -problem.conductivity_out * (rule.normal.transpose() * problem.field);
  if (problem.current_jump) current_data += problem.current_jump(rule);
  const Vector outer_data = trace.integrate(current_data);
  const Vector background = trace.integrate(-membrane * (rule.position.transpose() * problem.field));
  const dealii::Vector<double> lift = lifting(space, problem, outer);
  const auto boundary_value = [&](const Vector3& x) { return problem.conductivity_out * problem.outer.value(x); };

  Cost& cost = data->cost;
  const auto solve = [&](const Vector& memory) {
    Distributed b = right_side(space, space.dofs);
    add_membrane_functionals(space, constraints, background + memory, outer_data - background - memory, b);
    if (problem.outer.kind == OuterCondition::Kind::neumann && problem.outer.value) {
      add_outer_functional(space, constraints, boundary_value, b);
    }
    add_stiffness_action(space, constraints, form, -1.0, lift, b);
    b.compress(dealii::VectorOperation::add);
    data->nodal = system.solve(b, problem.tolerance, cost.iterations);
    data->nodal += lift;
  };
  if (const auto* charging = std::get_if<ChargingMembrane>(&problem.membrane)) {
    Vector voltage = charging->initial(rule);
    for (int step = 0; step < charging->steps; ++step) {
      solve(trace.integrate(charging->capacitance / charging->time_step * voltage));
      voltage = membrane_voltage(*data, rule);
    }
  } else {
    solve(Vector::Zero(trace.size()));
    if (mean_is_free(problem)) shift_to_mean(*data, std::get<SteadyMembrane>(problem.membrane).mean);
  }
  // E_∞·x is no trace function. Where V_m is small against it, the projection leaves that error out of V_m.
  data->voltage = trace.project(trace.integrate(membrane_voltage(*data, rule)));
  data->current = trace.project(problem.conductivity_in * inner_flux_functional(space, data->nodal));

  cost.n_cells = discretisation.n_cells();
  cost.n_unknowns = discretisation.n_nodes();
  cost.seconds_setup = space.seconds_setup;
  cost.seconds_assembly = system.seconds_assembly();
  cost.seconds_solve = watch.lap() - system.seconds_assembly();
  cost.peak_memory_bytes = peak_memory_bytes();
  return PotentialSolution(data);
}

PotentialTraces PotentialSolution::on_surface(const SurfacePoints& points) const {
  const Space& space = *data_->space;
  const PotentialProblem& problem = data_->problem;
  const double sigma_in = problem.conductivity_in;
  const double sigma_out = problem.conductivity_out;
  const Vector jump = problem.current_jump ? problem.current_jump(points) : Vector(Vector::Zero(points.size()));
  const Vector current = space.trace->evaluate(data_->current, points);

  PotentialTraces result;
  result.transmembrane_potential = space.trace->evaluate(data_->voltage, points);
  if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
    result.transmembrane_potential = prescribed->potential_jump(points);
  }
  result.flux_in = current / sigma_in;
  const Vector flux_out = (current - jump) / sigma_out;
  // Not flux_in − flux_out: that would not vanish to the last digit at equal conductivities.
  result.charge = (1.0 / sigma_in - 1.0 / sigma_out) * current + jump / sigma_out;

  result.flux_in_from_gradient.resize(points.size());
  result.force.resize(3, points.size());
  const auto normal_stress = [](double permittivity, const Vector3& tangential, double normal_field, const Vector3& n) {
    // n·Σ with E = E_t + E_n n: ε (E_n E_t + ½ (E_n² − E_t²) n).
    return Vector3(permittivity *
                   (normal_field * tangential + 0.5 * (normal_field * normal_field - tangential.squaredNorm()) * n));
  };
  for (const FaceRun& run : face_runs(points)) {
    const MembraneFace& face = space.membrane[run.face];
    const Vectors inner =
        cell_values(space, space.dofs, face.inner_cell, unit_points(space, points, run, Side::inside), true)
            .gradients(data_->nodal);
    const Vectors outer =
        cell_values(space, space.dofs, face.outer_cell, unit_points(space, points, run, Side::outside), true)
            .gradients(data_->nodal);
    for (Eigen::Index i = 0; i < run.size; ++i) {
      const Eigen::Index p = run.begin + i;
      const Vector3 n = points.normal.col(p);
      const auto tangential = [&](const Vector3& v) { return Vector3(v - n.dot(v) * n); };
      const Vector3 field_in = -inner.col(i);
      const Vector3 field_out = problem.field - outer.col(i);
      result.flux_in_from_gradient[p] = n.dot(inner.col(i));
      result.force.col(p) = normal_stress(problem.permittivity_in, tangential(field_in), -result.flux_in[p], n) -
                            normal_stress(problem.permittivity_out, tangential(field_out), -flux_out[p], n);
    }
  }
  result.charge_from_gradient = (1.0 - sigma_in / sigma_out) * result.flux_in_from_gradient + jump / sigma_out;
  return result;
}

Vector PotentialSolution::potential(const VolumePoints& points) const {
  const Space& space = *data_->space;
  Vector result(points.size());
  for (const CellRun& run : cell_runs(points)) {
    result.segment(run.begin, run.size) =
        cell_values(space, space.dofs, run.cell, run.units, false).values(data_->nodal);
  }
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    if (!points.inside[i]) result[i] -= data_->problem.field.dot(points.position.col(i));
  }
  return result;
}

const Cost& PotentialSolution::cost() const { return data_->cost; }

}  // namespace vehd::fem_check
