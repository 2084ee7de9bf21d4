#include "fem_check/cell_points.hpp"
#include "fem_check/potential_data.hpp"

namespace vehd::fem_check {
namespace {

/// v − ψ at the nodes of γ.
Vector sheet_difference(const Space& space, const dealii::Vector<double>& nodal) {
  const auto& pairs = space.trace->pairs().pairs;
  Vector result(space.trace->size());
  for (std::size_t p = 0; p < pairs.size(); ++p) result[p] = nodal[pairs[p][0]] - nodal[pairs[p][1]];
  return result;
}

}  // namespace

Vector membrane_voltage(const PotentialSolution::Data& data, const SurfacePoints& points) {
  return data.space->trace->evaluate(sheet_difference(*data.space, data.nodal), points) + data.background(points);
}

PotentialTraces PotentialSolution::on_surface(const SurfacePoints& points) const {
  const Space& space = *data_->space;
  const PotentialProblem& problem = data_->problem;
  const double sigma_out = problem.conductivity_out;
  const Vector jump = problem.current_jump ? problem.current_jump(points) : Vector(Vector::Zero(points.size()));
  const Vector current = space.trace->evaluate(data_->current, points);

  PotentialTraces result;
  result.transmembrane_potential = space.trace->evaluate(data_->voltage, points);
  if (const auto* prescribed = std::get_if<PrescribedJump>(&problem.membrane)) {
    result.transmembrane_potential = prescribed->potential_jump(points);
  }
  const Vector flux_out = (current - jump) / sigma_out;
  result.flux_in.resize(points.size());
  result.charge.resize(points.size());
  for (Eigen::Index p = 0; p < points.size(); ++p) {
    const double sigma_in = problem.conductivity_in[points.vesicle[p]];
    result.flux_in[p] = current[p] / sigma_in;
    // Computed with σ_e − σ_i, not as flux_in − flux_out: no cancellation if the conductivities are nearly equal.
    result.charge[p] = (sigma_out - sigma_in) / (sigma_in * sigma_out) * current[p] + jump[p] / sigma_out;
  }

  result.flux_in_from_gradient.resize(points.size());
  result.charge_from_gradient.resize(points.size());
  result.force.resize(3, points.size());
  const auto normal_stress = [](double permittivity, const Vector3& tangential, double normal_field, const Vector3& n) {
    // n·Σ with E = E_t + E_n n: ε (E_n E_t + ½ (E_n² − E_t²) n).
    return Vector3(permittivity *
                   (normal_field * tangential + 0.5 * (normal_field * normal_field - tangential.squaredNorm()) * n));
  };
  CellPoints cell(space, space.dofs);
  for (const FaceRun& run : face_runs(points)) {
    const MembraneFace& face = space.membrane[run.face];
    cell.reinit(face.inner_cell, unit_points(space, points, run, Side::inside));
    const Vectors inner = cell.gradients(data_->nodal);
    cell.reinit(face.outer_cell, unit_points(space, points, run, Side::outside));
    const Vectors outer = cell.gradients(data_->nodal);
    for (Eigen::Index i = 0; i < run.size; ++i) {
      const Eigen::Index p = run.begin + i;
      const Vector3 n = points.normal.col(p);
      const auto tangential = [&](const Vector3& v) { return Vector3(v - n.dot(v) * n); };
      const Vector3 field_in = -inner.col(i);
      const Vector3 field_out = problem.field - outer.col(i);
      result.flux_in_from_gradient[p] = n.dot(inner.col(i));
      const int vesicle = points.vesicle[p];
      result.charge_from_gradient[p] =
          (sigma_out - problem.conductivity_in[vesicle]) / sigma_out * result.flux_in_from_gradient[p] +
          jump[p] / sigma_out;
      result.force.col(p) =
          normal_stress(problem.permittivity_in[vesicle], tangential(field_in), -result.flux_in[p], n) -
          normal_stress(problem.permittivity_out, tangential(field_out), -flux_out[p], n);
    }
  }
  return result;
}

Vector PotentialSolution::potential(const VolumePoints& points) const {
  const Space& space = *data_->space;
  Vector result(points.size());
  CellPoints cell(space, space.dofs);
  for (const CellRun& run : cell_runs(points)) {
    cell.reinit(run.cell, run.units);
    result.segment(run.begin, run.size) = cell.values(data_->nodal);
  }
  const Vector3& field = data_->problem.field;
  for (Eigen::Index i = 0; i < points.size(); ++i) {
    const int vesicle = space.vesicle(static_cast<unsigned>(points.cell[i]));
    result[i] +=
        points.inside[i] ? data_->constant[vesicle] - field.dot(space.centre) : -field.dot(points.position.col(i));
  }
  return result;
}

const Cost& PotentialSolution::cost() const { return data_->cost; }

}  // namespace vehd::fem_check
