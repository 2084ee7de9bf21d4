#include "fem_check/flow.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fem_check/saddle_point.hpp"

namespace vehd::fem_check {

/// The unknown is the disturbance u = v − A x.
struct FlowSolution::Data {
  std::shared_ptr<const Space> space;
  std::unique_ptr<dealii::DoFHandler<3>> pressure_dofs;
  Matrix3 gradient;
  std::array<dealii::Vector<double>, 3> velocity;
  dealii::Vector<double> pressure;
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
  Cost cost;
};

namespace {

using FlowData = FlowSolution::Data;

void require_valid(const Discretisation& discretisation, const FlowProblem& problem) {
  if (discretisation.degree() < 2) {
    throw std::invalid_argument("the flow takes elements of degree 2 at least, the discretisation has degree " +
                                std::to_string(discretisation.degree()));
  }
  for (const double viscosity : {problem.viscosity_in, problem.viscosity_out}) {
    if (!(viscosity > 0.0)) {
      throw std::invalid_argument("viscosity is " + std::to_string(viscosity) + "; must be positive");
    }
  }
  if (std::abs(problem.gradient.trace()) > 1e-12 * problem.gradient.norm()) {
    throw std::invalid_argument("the background flow has divergence " + std::to_string(problem.gradient.trace()) +
                                "; an incompressible fluid has none");
  }
  if (!problem.force) throw std::invalid_argument("the force of the membrane is missing");
}

/// −p n + μ ∂u/∂r + (4μ/R) u of the Stokeslet and the rotlet that carry the force and the torque: zero for every
/// stresslet.
Vector3 outer_data(const Vector3& r, const Vector3& force, const Vector3& torque, double viscosity) {
  const double radius = r.norm();
  const Vector3 n = r / radius;
  const double scale = 1.0 / (8.0 * std::numbers::pi * viscosity * radius);
  const Vector3 stokeslet = scale * (force + n.dot(force) * n);
  const Vector3 rotlet = scale / radius * torque.cross(n);
  const double pressure = force.dot(n) / (4.0 * std::numbers::pi * radius * radius);
  return 3.0 * viscosity / radius * stokeslet + 2.0 * viscosity / radius * rotlet - pressure * n;
}

Constraints tie_sheets(const Space& space) {
  Constraints constraints;
  constraints.reinit(dealii::complete_index_set(space.dofs.n_dofs()));
  for (const auto& [inner, outer] : space.trace->pairs().pairs) {
    constraints.add_line(inner);
    constraints.add_entry(inner, outer, 1.0);
  }
  constraints.close();
  return constraints;
}

Vector values_at(const Space& space, const dealii::DoFHandler<3>& handler, const dealii::Vector<double>& nodal,
                 const VolumePoints& points) {
  Vector result(points.size());
  for (const CellRun& run : cell_runs(points)) {
    result.segment(run.begin, run.size) = cell_values(space, handler, run.cell, run.units, false).values(nodal);
  }
  return result;
}

}  // namespace

FlowSolution solve_flow(const Discretisation& discretisation, const FlowProblem& problem) {
  require_valid(discretisation, problem);
  const auto data = std::make_shared<FlowData>();
  data->space = discretisation.space();
  data->gradient = problem.gradient;
  const Space& space = *data->space;
  const SurfacePoints& rule = space.trace->rule();
  const Vector3 centre = space.mesh->centre();
  Stopwatch watch;

  const Constraints constraints = tie_sheets(space);
  data->pressure_dofs = std::make_unique<dealii::DoFHandler<3>>(space.triangulation);
  data->pressure_dofs->distribute_dofs(dealii::FE_Q<3>(space.element.degree - 1));
  const SaddlePoint system(space, *data->pressure_dofs, constraints, {problem.viscosity_in, problem.viscosity_out});
  const Vectors force = problem.force(rule);
  for (Eigen::Index i = 0; i < rule.size(); ++i) {
    data->force += rule.weight[i] * force.col(i);
    data->torque += rule.weight[i] * (rule.position.col(i) - centre).cross(Vector3(force.col(i)));
  }
  // The background flow has a traction jump of its own where viscosities differ.
  const Matrix3 background =
      (problem.viscosity_in - problem.viscosity_out) * (problem.gradient + problem.gradient.transpose());
  const Vectors traction = force - background * rule.normal;
  Blocks b = system.zero();
  for (int d = 0; d < 3; ++d) {
    const Vector functional = space.trace->integrate(traction.row(d).transpose());
    add_membrane_functionals(space, constraints, functional, Vector::Zero(functional.size()), b.block(d));
    add_outer_functional(
        space, constraints,
        [&](const Vector3& x) { return outer_data(x - centre, data->force, data->torque, problem.viscosity_out)[d]; },
        b.block(d));
  }
  b.compress(dealii::VectorOperation::add);
  Cost& cost = data->cost;
  const Blocks x = system.solve(b, problem.tolerance, cost.iterations);
  for (unsigned d = 0; d < 3; ++d) {
    data->velocity[d] = dealii::Vector<double>(x.block(d));
    constraints.distribute(data->velocity[d]);
  }
  data->pressure = dealii::Vector<double>(x.block(3));

  cost.n_cells = discretisation.n_cells();
  cost.n_unknowns = static_cast<long>(b.size());
  cost.seconds_setup = space.seconds_setup;
  cost.seconds_assembly = system.seconds_assembly();
  cost.seconds_solve = watch.lap() - cost.seconds_assembly;
  cost.peak_memory_bytes = peak_memory_bytes();
  return FlowSolution(data);
}

FlowTraces FlowSolution::on_surface(const SurfacePoints& points) const {
  const Space& space = *data_->space;
  const Matrix3& a = data_->gradient;
  FlowTraces result{a * points.position, Vector(points.size())};
  for (const FaceRun& run : face_runs(points)) {
    const CellValues cell = cell_values(space, space.dofs, space.membrane[run.face].inner_cell,
                                        unit_points(space, points, run, Side::inside), true);
    std::array<Vectors, 3> gradients;
    for (int d = 0; d < 3; ++d) {
      result.velocity.row(d).segment(run.begin, run.size) += cell.values(data_->velocity[d]).transpose();
      gradients[d] = cell.gradients(data_->velocity[d]);
    }
    for (Eigen::Index i = 0; i < run.size; ++i) {
      Matrix3 gradient = a;
      for (int d = 0; d < 3; ++d) gradient.row(d) += gradients[d].col(i).transpose();
      const Vector3 n = points.normal.col(run.begin + i);
      result.divergence[run.begin + i] = gradient.trace() - n.dot(gradient * n);
    }
  }
  return result;
}

Vectors FlowSolution::velocity(const VolumePoints& points) const {
  Vectors result = data_->gradient * points.position;
  for (int d = 0; d < 3; ++d) {
    result.row(d) += values_at(*data_->space, data_->space->dofs, data_->velocity[d], points).transpose();
  }
  return result;
}

Vector FlowSolution::pressure(const VolumePoints& points) const {
  return values_at(*data_->space, *data_->pressure_dofs, data_->pressure, points);
}

const Vector3& FlowSolution::net_force() const { return data_->force; }
const Vector3& FlowSolution::net_torque() const { return data_->torque; }
const Cost& FlowSolution::cost() const { return data_->cost; }

}  // namespace vehd::fem_check
