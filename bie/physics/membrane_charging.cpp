#include "bie/physics/membrane_charging.hpp"

#include <limits>

#include "bie/linear/subspace_solve.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Solves (½ + ηS′)(a V − b) − κ D′[V] = κ E·n; the whole equation is divided by a + κ/R, which may be of any size.
SolveReport solve_charging(const ChargingEquation& equation, const Membrane& membrane, const Vector& right_side,
                           const SolveOptions& options, Vector& potential) {
  const LinearMap map = [&](const Vector& v) { return equation.own(v); };
  const LinearMap preconditioner = [&](const Vector& r) { return equation.sphere_inverse(r); };
  return solve_within(membrane.subspace.potentials(), map, preconditioner, right_side, potential, options);
}

/// The same a everywhere. @param b  coefficients
SolveReport solve_uniform_charging(const ElectricParameters& electric, const Membrane& membrane, double a,
                                   const Vector& b, double tolerance, Vector& potential) {
  const ChargingEquation equation(electric, membrane, a);
  return solve_charging(equation, membrane, equation.right_side(b), {tolerance, 60}, potential);
}

}  // namespace

ChargingEquation::ChargingEquation(const ElectricParameters& electric, const Membrane& membrane, double a)
    : electric_(electric), membrane_(membrane), eta_(conductivity_contrast(electric)) {
  const double kappa = series_conductivity(electric);
  size_ = a + kappa / membrane.radius;
  storage_ = a / size_;
  conduction_ = kappa / size_;
}

ChargingEquation::ChargingEquation(const ElectricParameters& electric, const Membrane& membrane, const Vector& a)
    : ChargingEquation(electric, membrane, a.dot(membrane.surface.quadrature) / membrane.surface.quadrature.sum()) {
  varying_storage_ = a / size_;
}

/// Coefficients of J a V over the size.
Vector ChargingEquation::weighted_storage(const Vector& v) const {
  const Vector values = membrane_.fine.synthesize(v);
  return membrane_.weighted(varying_storage_.cwiseProduct(values));
}

Vector ChargingEquation::own(const Vector& v) const {
  const SphereTransform& fine = membrane_.fine;
  const bool varies = varying_storage_.size() > 0;
  Vector result = Vector::Zero(v.size());
  // No net current: the mean obeys ∫(a V − b) dA = 0 alone, and is free (hence zero) without storage.
  double mean = v[0];
  if (varies || storage_ > 0.0) {
    const Vector stored = varies ? weighted_storage(v) : Vector(membrane_.weighted(fine.synthesize(v)));
    const double uniform = varies ? 1.0 : storage_;
    result += uniform * second_kind_operator(membrane_, eta_, stored);
    mean = uniform * stored[0];
  }
  if (conduction_ > 0.0) result -= conduction_ * fine.analyze(weighted_hypersingular(membrane_, v));
  result[0] = mean;
  return result;
}

Vector ChargingEquation::sphere_inverse(const Vector& r) const {
  const double radius = membrane_.radius;
  Vector result(r.size());
  for (int n = 0; n <= membrane_.fine.order(); ++n) {
    const double odd = 2.0 * n + 1.0;
    const double second_kind = n == 0 ? 1.0 : 0.5 - eta_ / (2.0 * odd);
    double eigenvalue = storage_ * radius * radius * second_kind + conduction_ * radius * n * (n + 1.0) / odd;
    if (eigenvalue == 0.0) eigenvalue = 1.0;
    for (Index i = coefficient_index(n, -n); i <= coefficient_index(n, n); ++i) result[i] = r[i] / eigenvalue;
  }
  return result;
}

Vector ChargingEquation::right_side(const Vector& b) const {
  return right_side_of_weighted(membrane_.weighted(membrane_.fine.synthesize(b)) / size_, b.isZero(0.0));
}

Vector ChargingEquation::right_side_of_values(const Vector& b) const {
  return right_side_of_weighted(membrane_.weighted(b) / size_, b.isZero(0.0));
}

Vector ChargingEquation::right_side_of_weighted(const Vector& weighted_b, bool is_zero) const {
  Vector rhs = conduction_ * membrane_.fine.analyze(weighted_field_flux(membrane_, electric_.field));
  if (!is_zero) rhs += second_kind_operator(membrane_, eta_, weighted_b);
  rhs[0] = storage_ > 0.0 ? weighted_b[0] : 0.0;
  return rhs;
}

SolveReport solve_varying_charging(const ElectricParameters& electric, const Membrane& membrane, const Vector& a,
                                   const Vector& b, double tolerance, Vector& potential) {
  const ChargingEquation equation(electric, membrane, a);
  return solve_charging(equation, membrane, equation.right_side_of_values(b), {tolerance, 120}, potential);
}

Vector capacitance_of(const ChargingParameters& charging, const Membrane& membrane) {
  const Vector& varies = membrane.material.capacitance;
  return varies.size() > 0 ? varies : Vector(Vector::Constant(membrane.surface.n_points(), charging.capacitance));
}

Vector conductance_of(const ChargingParameters& charging, const Membrane& membrane) {
  const Vector& varies = membrane.material.conductance;
  return varies.size() > 0 ? varies : Vector(Vector::Constant(membrane.surface.n_points(), charging.conductance));
}

bool charges_by_place(const Membrane& membrane) {
  const MembraneMaterial& material = membrane.material;
  return material.capacitance.size() > 0 || material.conductance.size() > 0 || material.pump_current.size() > 0;
}

MembraneCurrent membrane_current(const ElectricParameters& electric, const ChargingParameters& charging,
                                 const Membrane& membrane) {
  const Vector& pump = membrane.material.pump_current;
  return {conductance_of(charging, membrane),
          pump.size() > 0 ? Vector(electric.pump * pump) : Vector(Vector::Zero(membrane.surface.n_points()))};
}

ChargingStep charging_step(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Membrane& membrane, double dt, const Vector& potential) {
  const Vector storage = capacitance_of(charging, membrane) / dt;
  ChargingStep step{storage + conductance_of(charging, membrane),
                    storage.cwiseProduct(Vector(membrane.fine.synthesize(potential)))};
  const Vector& pump = membrane.material.pump_current;
  if (pump.size() > 0) step.b -= electric.pump * pump;
  return step;
}

SolveReport charge_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                            const Membrane& membrane, double dt, double tolerance, Vector& potential) {
  if (charges_by_place(membrane)) {
    const ChargingStep step = charging_step(electric, charging, membrane, dt, potential);
    return solve_varying_charging(electric, membrane, step.a, step.b, tolerance, potential);
  }
  const double capacitive = charging.capacitance / dt;
  const Vector b = capacitive * potential;
  return solve_uniform_charging(electric, membrane, capacitive + charging.conductance, b, tolerance, potential);
}

SolveReport steady_potential(const ElectricParameters& electric, const ChargingParameters& charging,
                             const Membrane& membrane, double tolerance, Vector& potential) {
  if (charging.conductance == 0.0 && series_conductivity(electric) == 0.0) {
    throw InputError("a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
  }
  const Vector b = Vector::Zero(n_coefficients(membrane.fine.order()));
  if (potential.size() == 0) potential = b;
  if (charges_by_place(membrane)) {
    const ChargingStep step =
        charging_step(electric, charging, membrane, std::numeric_limits<double>::infinity(), potential);
    if (step.a.maxCoeff() > 0.0) {
      return solve_varying_charging(electric, membrane, step.a, step.b, tolerance, potential);
    }
    if (membrane.material.pump_current.size() > 0) {
      throw InputError("a steady V_m is not determined: a pump works on a membrane that does not conduct");
    }
  }
  return solve_uniform_charging(electric, membrane, charging.conductance, b, tolerance, potential);
}

}  // namespace vehd
