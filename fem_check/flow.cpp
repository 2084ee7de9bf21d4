#include "fem_check/flow.hpp"

#include "fem_check/cell_points.hpp"
#include "fem_check/stokes_system.hpp"

namespace vehd::fem_check {

/// The unknown is the disturbance u = v − A x.
struct FlowSolution::Data {
  std::shared_ptr<const Space> space;
  std::shared_ptr<const dealii::DoFHandler<3>> pressure_dofs;
  Matrix3 gradient;
  std::array<dealii::Vector<double>, 3> velocity;
  dealii::Vector<double> pressure;
  Cost cost;
};

namespace {

using FlowData = FlowSolution::Data;

}  // namespace

FlowSolution flow_solution(const StokesSystem& system, const FlowProblem& problem, const Blocks& solution, Cost cost) {
  const auto data = std::make_shared<FlowData>();
  data->space = system.shared_space();
  data->pressure_dofs = system.pressure_dofs();
  data->gradient = problem.gradient;
  for (unsigned d = 0; d < 3; ++d) data->velocity[d] = system.velocity(solution, d);
  data->pressure = system.pressure(solution);
  cost.n_unknowns = static_cast<long>(solution.size());
  cost.peak_memory_bytes = peak_memory_bytes();
  data->cost = cost;
  return FlowSolution(data);
}

void begin_from(const FlowSolution& start, const StokesSystem& system, Blocks& solution) {
  const FlowData& data = start.data();
  const Stiffness& scalar = system.diffusion();
  for (unsigned d = 0; d < 3; ++d) {
    interpolate(data.space->dofs, data.velocity[d], scalar.handler(), scalar.constraints(), solution.block(d));
  }
  const Constraints none;
  interpolate(*data.pressure_dofs, data.pressure, *system.pressure_dofs(), none, solution.block(3));
  solution.block(3) *= 1.0 / system.pressure_unit();
}

FlowOperators::FlowOperators(const Discretisation& discretisation, const PerVesicle<double>& viscosity_in,
                             double viscosity_out, WallFlow wall)
    : data_(std::make_shared<const Data>(Data{StokesSystem(discretisation, {viscosity_in, viscosity_out}, wall)})) {}

FlowSolution solve_flow(const Discretisation& discretisation, const FlowProblem& problem, const FlowSolution* start) {
  return solve_flow(FlowOperators(discretisation, problem.viscosity_in, problem.viscosity_out, problem.wall), problem,
                    start);
}

FlowSolution solve_flow(const FlowOperators& operators, const FlowProblem& problem, const FlowSolution* start) {
  Cost cost;
  const StokesSystem system = system_for(operators, problem);
  Blocks solution = system.zero();
  if (start != nullptr) begin_from(*start, system, solution);
  system.solve(system.load(problem.force, problem.gradient), problem.tolerance, solution, cost);
  return flow_solution(system, problem, solution, cost);
}

FlowTraces FlowSolution::on_surface(const SurfacePoints& points) const {
  const Space& space = *data_->space;
  const Matrix3& a = data_->gradient;
  FlowTraces result{a * points.position, Vector(points.size())};
  CellPoints cell(space, space.dofs);
  for (const FaceRun& run : face_runs(points)) {
    cell.reinit(space.membrane[run.face].inner_cell, unit_points(space, points, run, Side::inside));
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
  CellPoints cell(*data_->space, data_->space->dofs);
  for (const CellRun& run : cell_runs(points)) {
    cell.reinit(run.cell, run.units);
    for (int d = 0; d < 3; ++d) {
      result.row(d).segment(run.begin, run.size) += cell.values(data_->velocity[d]).transpose();
    }
  }
  return result;
}

Vector FlowSolution::pressure(const VolumePoints& points) const {
  Vector result(points.size());
  CellPoints cell(*data_->space, *data_->pressure_dofs);
  for (const CellRun& run : cell_runs(points)) {
    cell.reinit(run.cell, run.units);
    result.segment(run.begin, run.size) = cell.values(data_->pressure);
  }
  return result;
}

const Cost& FlowSolution::cost() const { return data_->cost; }

}  // namespace vehd::fem_check
