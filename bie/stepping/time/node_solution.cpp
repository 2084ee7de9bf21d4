#include "bie/stepping/time/node_solution.hpp"

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/symmetry.hpp"

namespace vehd {

namespace {

TensionIntegrals tension_integrals(const VesicleSolution& solution, const VesicleFields& fields) {
  if (fields.tension.size() == 0 || solution.is_sphere) return {};
  const Membrane& membrane = *solution.membrane;
  const Vector tension = membrane.fine.synthesize(fields.tension);
  return {tension.dot(membrane.surface.quadrature), tension.cwiseAbs().dot(membrane.surface.quadrature)};
}

double largest_value(const SphereTransform& fine, const Matrix& coefficients) {
  return fine.synthesize(coefficients).cwiseAbs().maxCoeff();
}

State state_with(const StepStart& start, SurfaceFields Motion::*fields, const NodeSolution& node) {
  State state = without_past(start.state);
  state.time = node.time;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    VesicleState& vesicle = state.vesicles[a];
    static_cast<SurfaceFields&>(vesicle) =
        symmetric_part(start.discretisation.vesicle(a).subspace(), node.vesicles[a].*fields);
    vesicle.recycled = start.solved.vesicles[a].recycled;
  }
  return with_images(start.discretisation.symmetry().exchange, std::move(state));
}

}  // namespace

State state_at(const StepStart& start, const NodeSolution& node) {
  State state = state_with(start, &Motion::arrived, node);
  ++state.step;
  return state;
}

State material_state(const StepStart& start, const NodeSolution& node) {
  return state_with(start, &Motion::material, node);
}

Rate rate_of(const SolvedFields& solved) {
  Rate rate;
  for (std::size_t a = 0; a < solved.vesicles.size(); ++a) {
    const VesicleSolution& solution = solved.vesicles[a];
    const VesicleFields& fields = solved.fields.vesicles[a];
    rate.unknowns.push_back(solution.rate);
    rate.instantaneous.push_back({fields.charge_amplitude.size() > 0 ? fields.charge_amplitude : Matrix(fields.charge),
                                  fields.potential_amplitude, tension_integrals(solution, fields)});
  }
  return rate;
}

InstantaneousDifference instantaneous_difference(const Model& model, const SolvedFields& grids, const Rate& a,
                                                 const Rate& b) {
  InstantaneousDifference largest;
  for (std::size_t i = 0; i < b.instantaneous.size(); ++i) {
    const Rate::Instantaneous& x = a.instantaneous[i];
    const Rate::Instantaneous& y = b.instantaneous[i];
    const double tension = std::abs(y.tension.sum - x.tension.sum);
    largest.tension = std::max(largest.tension, tension / tension_scale(model, i, y.tension.magnitude));
    if (x.charge.size() == 0 || y.charge.size() == 0) continue;
    const Membrane& membrane = *grids.vesicles[i].membrane;
    const SphereTransform& fine = membrane.fine;
    const auto change = [&](const Matrix& from, const Matrix& to) {
      return largest_value(fine, to - resize_order(from, fine.order()));
    };
    largest.charge =
        std::max(largest.charge, change(x.charge, y.charge) / charge_scale(model, i, largest_value(fine, y.charge)));
    if (y.potential_amplitude.size() == 0) continue;
    const double size = largest_value(fine, y.potential_amplitude);
    largest.charge = std::max(largest.charge, change(x.potential_amplitude, y.potential_amplitude) /
                                                  potential_scale(*model.electric, membrane.radius, size));
  }
  return largest;
}

namespace {

double potential_difference(const StepStart& start, std::size_t a, const SurfaceFields& x, const SurfaceFields& y) {
  if (y.transmembrane_potential.size() == 0) return 0.0;
  const SphereTransform& fine = start.discretisation.vesicle(a).fine_transform();
  const double size = largest_value(fine, y.transmembrane_potential);
  return largest_value(fine, y.transmembrane_potential - x.transmembrane_potential) /
         potential_scale(*start.model.electric, start.solved.vesicles[a].membrane->radius, size);
}

/// Without a scale: the state of poration is a number of the order of one, or a logarithm.
double poration_difference(const StepStart& start, std::size_t a, const SurfaceFields& x, const SurfaceFields& y) {
  if (y.poration.size() == 0) return 0.0;
  return largest_value(start.discretisation.vesicle(a).fine_transform(), y.poration - x.poration);
}

double normal_difference(const StepStart& start, std::size_t a, const SurfaceFields& x, const SurfaceFields& y) {
  const SphereTransform& fine = start.discretisation.vesicle(a).fine_transform();
  const SphereDerivatives there = fine.synthesize_gradient(y.position);
  const Matrix change = fine.synthesize(y.position - x.position);
  double largest = 0.0;
  for (Index i = 0; i < change.rows(); ++i) {
    const Vector3 across = Vector3(there.d1.row(i)).cross(Vector3(there.d2.row(i)));
    largest = std::max(largest, std::abs(across.dot(Vector3(change.row(i)))) / across.norm());
  }
  return largest / start.solved.vesicles[a].membrane->radius;
}

}  // namespace

double difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.vesicles.size(); ++i) {
    const SurfaceFields& x = a.vesicles[i].material;
    const SurfaceFields& y = b.vesicles[i].material;
    const SphereTransform& fine = start.discretisation.vesicle(i).fine_transform();
    const double moved = fine.synthesize(y.position - x.position).rowwise().norm().maxCoeff();
    largest = std::max({largest, moved / start.solved.vesicles[i].membrane->radius,
                        potential_difference(start, i, x, y), poration_difference(start, i, x, y)});
  }
  return largest;
}

VisibleDifference visible_difference(const StepStart& start, const NodeSolution& a, const NodeSolution& b) {
  VisibleDifference largest;
  for (std::size_t i = 0; i < a.vesicles.size(); ++i) {
    const SurfaceFields& x = a.vesicles[i].material;
    const SurfaceFields& y = b.vesicles[i].material;
    largest.shape = std::max(largest.shape, normal_difference(start, i, x, y));
    largest.potential =
        std::max({largest.potential, potential_difference(start, i, x, y), poration_difference(start, i, x, y)});
  }
  return largest;
}

}  // namespace vehd
