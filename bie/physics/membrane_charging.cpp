#include "bie/physics/membrane_charging.hpp"

#include "bie/linear/subspace_solve.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Solves (½ + ηS′)(a V − b) − κ D′[V] = κ E·n; the whole equation is divided by a + κ/R, which may be of any size.
SolveReport solve_charging(const ElectricParameters& electric, const Membrane& membrane, double a, const Vector& b,
                           double tolerance, Vector& potential) {
  const double eta = conductivity_contrast(electric);
  const double kappa = series_conductivity(electric);
  const double radius = membrane.radius;
  const double size = a + kappa / radius;
  const double storage = a / size;
  const double conduction = kappa / size;  // a length, R at most
  const SphereTransform& fine = membrane.fine;

  const LinearMap map = [&](const Vector& v) {
    Vector result = Vector::Zero(v.size());
    if (storage > 0.0) {
      result += storage * second_kind_operator(membrane, eta, membrane.weighted(fine.synthesize(v)));
    }
    if (conduction > 0.0) result -= conduction * fine.analyze(weighted_hypersingular(membrane, v));
    // No net current: the mean obeys ∫(a V − b) dA = 0 alone, and is free (hence zero) without storage.
    result[0] = storage > 0.0 ? storage * membrane.weighted(fine.synthesize(v))(0, 0) : v[0];
    return result;
  };
  const LinearMap preconditioner = [&](const Vector& r) {
    Vector result(r.size());
    for (int n = 0; n <= fine.order(); ++n) {
      const double odd = 2.0 * n + 1.0;
      const double second_kind = n == 0 ? 1.0 : 0.5 - eta / (2.0 * odd);
      double eigenvalue = storage * radius * radius * second_kind + conduction * radius * n * (n + 1.0) / odd;
      if (eigenvalue == 0.0) eigenvalue = 1.0;
      for (Index i = coefficient_index(n, -n); i <= coefficient_index(n, n); ++i) result[i] = r[i] / eigenvalue;
    }
    return result;
  };

  const Vector weighted_b = membrane.weighted(fine.synthesize(b)) / size;
  Vector rhs = conduction * fine.analyze(weighted_field_flux(membrane, electric.field));
  if (!b.isZero(0.0)) rhs += second_kind_operator(membrane, eta, weighted_b);
  rhs[0] = storage > 0.0 ? weighted_b[0] : 0.0;
  return solve_within(membrane.subspace.potentials(), map, preconditioner, rhs, potential, {tolerance, 60});
}

}  // namespace

SolveReport charge_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                            const Membrane& membrane, double dt, double tolerance, Vector& potential) {
  const double capacitive = charging.capacitance / dt;
  const Vector b = capacitive * potential;
  return solve_charging(electric, membrane, capacitive + charging.conductance, b, tolerance, potential);
}

SolveReport steady_potential(const ElectricParameters& electric, const ChargingParameters& charging,
                             const Membrane& membrane, double tolerance, Vector& potential) {
  if (charging.conductance == 0.0 && series_conductivity(electric) == 0.0) {
    throw InputError("a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
  }
  const Vector b = Vector::Zero(n_coefficients(membrane.fine.order()));
  if (potential.size() == 0) potential = b;
  return solve_charging(electric, membrane, charging.conductance, b, tolerance, potential);
}

}  // namespace vehd
