#include "bie/physics/point_sources.hpp"

#include <cmath>
#include <utility>

#include "bie/kernels/laplace.hpp"

namespace vehd {

PointSourceFields point_source_fields(const std::vector<PointSource>& sources, const Surface& surface) {
  const Index n = surface.n_points();
  PointSourceFields fields{Vector::Zero(n), Vector::Zero(n), Matrix::Zero(n, 3), Matrix::Zero(n, 3), {}, {}};
  for (const PointSource& source : sources) {
    const Matrix r = surface.position.rowwise() - source.position.transpose();
    const Vector distance = r.rowwise().norm();
    const double scale = kLaplacePrefactor * source.strength;
    (source.inside ? fields.potential_out : fields.potential_in) += scale * distance.cwiseInverse();
    (source.inside ? fields.gradient_out : fields.gradient_in) -=
        scale * (distance.array().cube().inverse().matrix().asDiagonal() * r);
  }
  fields.flux_in = fields.gradient_in.cwiseProduct(surface.normal).rowwise().sum();
  fields.flux_out = fields.gradient_out.cwiseProduct(surface.normal).rowwise().sum();
  return fields;
}

namespace {

/// n·Σ_el from the full gradient, E = −∇φ.
Matrix maxwell_traction_of_gradient(double permittivity, const Surface& s, const Matrix& gradient, const Vector& flux) {
  const Vector pressure = -0.5 * gradient.rowwise().squaredNorm();
  return permittivity * (flux.asDiagonal() * gradient + pressure.asDiagonal() * s.normal);
}

double relative_max(const Matrix& difference, const Matrix& reference) {
  return difference.rowwise().norm().maxCoeff() / reference.rowwise().norm().maxCoeff();
}

double relative_l2(const Surface& s, const Matrix& difference, const Matrix& reference) {
  return std::sqrt(s.quadrature.dot(difference.rowwise().squaredNorm()) /
                   s.quadrature.dot(reference.rowwise().squaredNorm()));
}

}  // namespace

JumpSolution solve_jumps(const ElectricParameters& electric, const Membrane& membrane, const Vector& potential,
                         const Vector& current_jump, double tolerance) {
  const Surface& s = membrane.surface;
  const SphereTransform& fine = membrane.fine;
  const double eta = conductivity_contrast(electric);
  const double sum = electric.conductivity_in + electric.conductivity_out;
  const Vector hypersingular = weighted_hypersingular(membrane, potential);
  const Vector rhs = eta * hypersingular + s.area_element.cwiseProduct(current_jump / sum);
  const SecondKindSolution density = solve_second_kind(membrane, eta, rhs, tolerance);

  ElectricTraces traces;
  traces.charge = density.values;
  // Two equations for two fluxes, [[∂φ/∂n]] = q and [[σ ∂φ/∂n]] = J_m, in a form that is regular at σ_i = σ_e: the mean
  // of the fluxes is the principal value S′[q] − D′[V].
  const Vector weighted_mean =
      fine.synthesize(membrane.layers.laplace_adjoint.apply(density.weighted)).col(0) - hypersingular;
  const Vector mean = weighted_mean.cwiseQuotient(s.area_element);
  traces.flux_in = mean + 0.5 * traces.charge;
  traces.flux_out = mean - 0.5 * traces.charge;
  const Vector layers =
      membrane.layers.laplace_single.apply(density.weighted) - membrane.layers.laplace_double.apply(potential);
  traces.potential_in = layers + 0.5 * potential;
  traces.potential_out = layers - 0.5 * potential;
  return {std::move(traces), density.report};
}

PointSourceErrors point_source_errors(const ElectricParameters& electric, const std::vector<PointSource>& sources,
                                      const Membrane& membrane, double tolerance) {
  const Surface& s = membrane.surface;
  const PointSourceFields exact = point_source_fields(sources, s);
  const Vector potential = membrane.fine.analyze(exact.potential_in - exact.potential_out);
  const Vector current_jump = electric.conductivity_in * exact.flux_in - electric.conductivity_out * exact.flux_out;
  const auto [traces, report] = solve_jumps(electric, membrane, potential, current_jump, tolerance);

  const Matrix force = electric_force(electric.permittivity, membrane, traces);
  const Matrix exact_force = maxwell_traction_of_gradient(electric.permittivity, s, exact.gradient_in, exact.flux_in) -
                             maxwell_traction_of_gradient(electric.permittivity, s, exact.gradient_out, exact.flux_out);
  const Vector exact_charge = exact.flux_in - exact.flux_out;
  return {relative_max(traces.charge - exact_charge, exact_charge), relative_max(force - exact_force, exact_force),
          relative_l2(s, traces.charge - exact_charge, exact_charge), relative_l2(s, force - exact_force, exact_force),
          report};
}

}  // namespace vehd
