#include "bie/physics/electric.hpp"

#include <cmath>

#include "bie/physics/real_maps.hpp"

namespace vehd {

namespace {

/// J n×∇_γ f = f_1 x_2 − f_2 x_1, [n_points x 3].
Matrix weighted_rotated_gradient(const Surface& s, const SphereDerivatives& f) {
  return f.d1.col(0).asDiagonal() * s.tangent_2 - f.d2.col(0).asDiagonal() * s.tangent_1;
}

}  // namespace

double conductivity_contrast(const ElectricParameters& electric) {
  return (electric.conductivity_in - electric.conductivity_out) /
         (electric.conductivity_in + electric.conductivity_out);
}

double series_conductivity(const ElectricParameters& electric) {
  return electric.conductivity_in *
         (electric.conductivity_out / (electric.conductivity_in + electric.conductivity_out));
}

bool carries_charge(const ElectricParameters& electric) {
  return conductivity_contrast(electric) != 0.0 ||
         (electric.displacement_current && (!electric.averaged_frequency || electric.permittivity_ratio != 1.0));
}

Vector weighted_hypersingular(const Membrane& membrane, const Vector& potential) {
  const Surface& s = membrane.surface;
  const Matrix density =
      membrane.fine.analyze(weighted_rotated_gradient(s, membrane.fine.synthesize_gradient(potential)));
  const SphereDerivatives layer = membrane.fine.synthesize_gradient(membrane.layers.laplace_single.apply(density));
  return (layer.d1.cwiseProduct(s.tangent_2) - layer.d2.cwiseProduct(s.tangent_1)).rowwise().sum();
}

Vector weighted_field_flux(const Membrane& membrane, const Vector3& field) {
  return membrane.surface.area_element.cwiseProduct(membrane.surface.normal * field);
}

ElectricTraces electric_traces(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                               const SecondKindSolution& density, const Vector& of_others) {
  const double sum = electric.conductivity_in + electric.conductivity_out;
  const double eta = conductivity_contrast(electric);
  ElectricTraces traces;
  traces.flux_in = -(electric.conductivity_out / sum) * density.values;
  traces.flux_out = -(electric.conductivity_in / sum) * density.values;
  traces.charge = eta * density.values;
  const Vector weighted_charge = eta == 0.0 ? Vector() : Vector(eta * density.weighted);
  const Vector mean = mean_potential<double>({electric, membrane}, potential, weighted_charge, of_others);
  traces.potential_in = mean + 0.5 * potential;
  traces.potential_out = mean - 0.5 * potential;
  return traces;
}

namespace {

/// n·Σ_el = ε (E_n E − ½|E|² n) for E = −∇_γ φ − ∂φ/∂n n, Eqs. (3) and (15).
Matrix maxwell_traction(double permittivity, const Membrane& membrane, const Vector& potential, const Vector& flux) {
  const Surface& s = membrane.surface;
  const Matrix tangential = -surface_gradient(s, membrane.fine.synthesize_gradient(potential));
  const Eigen::ArrayXd normal = -flux.array();
  const Vector pressure = 0.5 * (normal.square() - tangential.rowwise().squaredNorm().array());
  return permittivity * (Vector(normal).asDiagonal() * tangential + pressure.asDiagonal() * s.normal);
}

}  // namespace

Matrix electric_force(double permittivity, const Membrane& membrane, const ElectricTraces& traces,
                      double permittivity_ratio) {
  return maxwell_traction(permittivity_ratio * permittivity, membrane, traces.potential_in, traces.flux_in) -
         maxwell_traction(permittivity, membrane, traces.potential_out, traces.flux_out);
}

}  // namespace vehd
