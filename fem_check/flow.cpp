#include "fem_check/flow.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "fem_check/stokes_system.hpp"

namespace vehd::fem_check {

/// The unknown is the disturbance u = v − A x.
struct FlowSolution::Data {
  std::shared_ptr<const Space> space;
  std::shared_ptr<const dealii::DoFHandler<3>> pressure_dofs;
  Matrix3 gradient;
  std::array<dealii::Vector<double>, 3> velocity;
  dealii::Vector<double> pressure;
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
  Cost cost;
};

namespace {

using FlowData = FlowSolution::Data;

std::shared_ptr<const Space> space_for_flow(const Discretisation& discretisation, const Viscosities& viscosities) {
  if (discretisation.degree() < 2) {
    throw std::invalid_argument("the flow takes elements of degree 2 at least, the discretisation has degree " +
                                std::to_string(discretisation.degree()));
  }
  for (const double viscosity : {viscosities.inside, viscosities.outside}) {
    if (!(viscosity > 0.0)) {
      throw std::invalid_argument("viscosity is " + std::to_string(viscosity) + "; must be positive");
    }
  }
  return discretisation.space();
}

void require_valid(const FlowProblem& problem) {
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

struct Resultant {
  Vector3 force = Vector3::Zero();
  Vector3 torque = Vector3::Zero();
};

/// Net force and torque about the centre of the outer sphere.
Resultant resultant(const Space& space, const Vectors& force) {
  const SurfacePoints& rule = space.trace->rule();
  const Vector3 centre = space.mesh->centre();
  Resultant result;
  for (Eigen::Index i = 0; i < rule.size(); ++i) {
    result.force += rule.weight[i] * force.col(i);
    result.torque += rule.weight[i] * (rule.position.col(i) - centre).cross(Vector3(force.col(i)));
  }
  return result;
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

StokesSystem::StokesSystem(const Discretisation& discretisation, const Viscosities& viscosity)
    : space_(space_for_flow(discretisation, viscosity)), viscosity_(viscosity), constraints_(tie_sheets(*space_)) {
  pressure_dofs_ = std::make_shared<dealii::DoFHandler<3>>(space_->triangulation);
  pressure_dofs_->distribute_dofs(dealii::FE_Q<3>(space_->element.degree - 1));
  matrix_ = std::make_unique<SaddlePoint>(*space_, *pressure_dofs_, constraints_, viscosity_);
}

Blocks StokesSystem::right_side(const FlowProblem& problem) const {
  require_valid(problem);
  const SurfacePoints& rule = space_->trace->rule();
  const Vector3 centre = space_->mesh->centre();
  const Vectors force = problem.force(rule);
  const Resultant net = resultant(*space_, force);
  // The background flow has a traction jump of its own where viscosities differ.
  const Matrix3 background =
      (viscosity_.inside - viscosity_.outside) * (problem.gradient + problem.gradient.transpose());
  const Vectors traction = force - background * rule.normal;
  Blocks b = matrix_->zero();
  for (int d = 0; d < 3; ++d) {
    const Vector functional = space_->trace->integrate(traction.row(d).transpose());
    add_membrane_functionals(*space_, constraints_, functional, Vector::Zero(functional.size()), b.block(d));
    add_outer_functional(
        *space_, constraints_,
        [&](const Vector3& x) { return outer_data(x - centre, net.force, net.torque, viscosity_.outside)[d]; },
        b.block(d));
  }
  b.compress(dealii::VectorOperation::add);
  return b;
}

FlowSolution StokesSystem::solution(const FlowProblem& problem, const Blocks& x, const Cost& cost) const {
  const auto data = std::make_shared<FlowData>();
  data->space = space_;
  data->pressure_dofs = pressure_dofs_;
  data->gradient = problem.gradient;
  const Resultant net = resultant(*space_, problem.force(space_->trace->rule()));
  data->force = net.force;
  data->torque = net.torque;
  for (unsigned d = 0; d < 3; ++d) {
    data->velocity[d] = dealii::Vector<double>(x.block(d));
    constraints_.distribute(data->velocity[d]);
  }
  data->pressure = dealii::Vector<double>(x.block(3));
  data->cost = cost;
  data->cost.n_cells = static_cast<int>(space_->triangulation.n_active_cells());
  data->cost.n_unknowns = static_cast<long>(x.size());
  data->cost.seconds_setup = space_->seconds_setup;
  data->cost.seconds_assembly = matrix_->seconds_assembly();
  data->cost.peak_memory_bytes = peak_memory_bytes();
  return FlowSolution(data);
}

FlowSolution solve_flow(const Discretisation& discretisation, const FlowProblem& problem) {
  Stopwatch watch;
  const StokesSystem system(discretisation, {problem.viscosity_in, problem.viscosity_out});
  const Blocks b = system.right_side(problem);
  Cost cost;
  const Blocks x = system.matrix().solve(b, problem.tolerance, cost.iterations);
  cost.seconds_solve = watch.lap() - system.matrix().seconds_assembly();
  return system.solution(problem, x, cost);
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
