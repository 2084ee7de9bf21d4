#include "bie/physics/charge_relaxation.hpp"

#include <utility>

#include "bie/linear/subspace_solve.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// E_i = (aV − s_i)/k_i, E_e = (aV + s_e)/k_e: what conducts or is displaced on either side for what the membrane
/// takes.
struct FaceLaw {
  double a = 0.0;      ///< of V
  double k_in, k_out;  ///< of the fields
  Vector s_in, s_out;  ///< coefficients
};

/// J (½ f + side S′[f]), coefficients.
Vector half_and_adjoint(const Membrane& membrane, double side, const Vector& field) {
  const Vector weighted = membrane.weighted(membrane.fine.synthesize(field));
  return 0.5 * weighted + side * Vector(membrane.layers.laplace_adjoint.apply(weighted));
}

/// ½(E_i + E_e) + S′[E_e − E_i] − D′[V] = E·n with both fields in terms of V, times κ = k_i k_e/(k_i + k_e).
SolveReport solve_law(const ElectricParameters& electric, const Membrane& membrane, const FaceLaw& law,
                      double tolerance, Vector& potential) {
  ElectricParameters of_law = electric;
  of_law.conductivity_in = law.k_in;
  of_law.conductivity_out = law.k_out;
  const ChargingEquation equation(of_law, membrane, law.a);
  const SphereTransform& fine = membrane.fine;
  Vector rhs = fine.analyze(weighted_field_flux(membrane, electric.field)) +
               half_and_adjoint(membrane, -1.0, law.s_in / law.k_in) -
               half_and_adjoint(membrane, 1.0, law.s_out / law.k_out);
  rhs *= equation.conduction();
  // No net current: ∫(aV − s_i) dA = 0.
  const double over_size = equation.conduction() / series_conductivity(of_law);
  rhs[0] = over_size * membrane.weighted(fine.synthesize(law.s_in))(0, 0);
  if (potential.size() != rhs.size()) potential = Vector::Zero(rhs.size());
  const LinearMap map = [&](const Vector& v) { return equation.own(v); };
  const LinearMap preconditioner = [&](const Vector& r) { return equation.sphere_inverse(r); };
  return solve_within(membrane.subspace.potentials(), map, preconditioner, rhs, potential, {tolerance, 60});
}

double permittivity_in(const ElectricParameters& electric) {
  return electric.permittivity_ratio * electric.permittivity;
}

Vector without_mean(const Membrane& membrane, Vector values) {
  const Vector& area = membrane.surface.quadrature;
  values.array() -= values.dot(area) / area.sum();
  return values;
}

}  // namespace

RelaxingField field_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                               const Membrane& membrane, const FaceCharges& charges, double tolerance,
                               const Vector& start) {
  const double c = charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  RelaxingField field;
  field.potential = start;
  field.report = solve_law(electric, membrane, {c, in, out, c * charges.inner, c * (charges.sum - charges.inner)},
                           tolerance, field.potential);
  const SphereTransform& fine = membrane.fine;
  // E_e − E_i by C_m V, then the mean of both from their layers, which smooth: free of the truncation that C_m V − q_i
  // would magnify.
  const Vector difference =
      (c / out) * (field.potential + charges.sum - charges.inner) - (c / in) * (field.potential - charges.inner);
  const Vector weighted = membrane.weighted(fine.synthesize(difference));
  const Vector smoothed = fine.synthesize(membrane.layers.laplace_adjoint.apply(weighted));
  const Vector mean =
      (weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, field.potential) - smoothed)
          .cwiseQuotient(membrane.surface.area_element);
  const Vector free = c * fine.synthesize(charges.sum);
  const Vector jump = (2.0 / (in + out)) * ((in - out) * mean + free);
  ElectricTraces& traces = field.traces;
  traces.flux_in = 0.5 * jump - mean;
  traces.flux_out = -0.5 * jump - mean;
  traces.charge = jump;
  const Vector applied = fine.analyze(-(membrane.surface.position * electric.field));
  const Vector between = applied - Vector(membrane.layers.laplace_double.apply(field.potential)) +
                         Vector(membrane.layers.laplace_single.apply(weighted));
  traces.potential_in = between + 0.5 * field.potential;
  traces.potential_out = between - 0.5 * field.potential;
  return field;
}

FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field) {
  const Vector in = without_mean(membrane, -electric.conductivity_in * field.traces.flux_in);
  const Vector out = without_mean(membrane, -electric.conductivity_out * field.traces.flux_out);
  const Vector leak = charging.conductance * field.potential;
  return {(Vector(membrane.fine.analyze(in)) - leak) / charging.capacitance,
          Vector(membrane.fine.analyze(Vector(in - out))) / charging.capacitance};
}

SolveReport relax_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                          const Membrane& membrane, double dt, double tolerance, FaceCharges& charges) {
  const double c = charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  const FaceLaw law{c / dt + charging.conductance, electric.conductivity_in + in / dt,
                    electric.conductivity_out + out / dt, (c / dt) * charges.inner,
                    (c / dt) * (charges.sum - charges.inner)};
  Vector potential = charges.inner;
  const SolveReport report = solve_law(electric, membrane, law, tolerance, potential);
  const Vector field_in = (law.a * potential - law.s_in) / law.k_in;
  const Vector field_out = (law.a * potential + law.s_out) / law.k_out;
  charges.inner = potential - (in / c) * field_in;
  charges.sum = (out / c) * field_out - (in / c) * field_in;
  return report;
}

FaceCharges steady_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Vector& potential) {
  if (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0) {
    throw InputError(
        "a steady V_m with displacement currents needs fluids that both conduct; one conductivity is zero");
  }
  const double leak = charging.conductance / charging.capacitance;
  const double in = permittivity_in(electric) / electric.conductivity_in * leak;
  const double out = electric.permittivity / electric.conductivity_out * leak;
  return {(1.0 - in) * potential, (out - in) * potential};
}

}  // namespace vehd
