#include "bie/physics/charge_relaxation.hpp"

#include <utility>

#include "bie/linear/subspace_solve.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// J (½ f + side S′[f]), coefficients.
Vector half_and_adjoint(const Membrane& membrane, double side, const Vector& field) {
  const Vector weighted = membrane.weighted(membrane.fine.synthesize(field));
  return 0.5 * weighted + side * Vector(membrane.layers.laplace_adjoint.apply(weighted));
}

double permittivity_in(const ElectricParameters& electric) {
  return electric.permittivity_ratio * electric.permittivity;
}

/// A factor of V, values on the upsampled grid, times V, coefficients.
Vector product(const Membrane& membrane, const Vector& factor, const Vector& potential) {
  return membrane.fine.analyze(Vector(factor.cwiseProduct(Vector(membrane.fine.synthesize(potential)))));
}

/// C_m V over the C_m that charges are divided by.
Vector capacitive(const ChargingMembrane& of, const Vector& potential) {
  const Vector& varies = of.in_field.membrane.material.capacitance;
  if (varies.size() == 0) return potential;
  return product(of.in_field.membrane, varies, potential) / of.charging.capacitance;
}

/// G_m V + J_p, coefficients.
Vector current_through(const ElectricParameters& electric, const ChargingParameters& charging, const Membrane& membrane,
                       const Vector& potential) {
  if (!charges_by_place(membrane)) return charging.conductance * potential;
  const MembraneCurrent current = membrane_current(electric, charging, membrane);
  return membrane.fine.analyze(
      Vector(current.conductance.cwiseProduct(Vector(membrane.fine.synthesize(potential))) + current.constant));
}

Vector without_mean(const Membrane& membrane, Vector values) {
  const Vector& area = membrane.surface.quadrature;
  values.array() -= values.dot(area) / area.sum();
  return values;
}

}  // namespace

FaceLaw law_of_charges(const ChargingMembrane& of, const FaceCharges& charges) {
  const auto& [electric, membrane] = of.in_field;
  const double c = of.charging.capacitance;
  FaceLaw law{c, permittivity_in(electric), electric.permittivity, c * charges.inner,
              c * (charges.sum - charges.inner)};
  if (const Vector& varies = membrane.material.capacitance; varies.size() > 0) {
    law.a = varies.maxCoeff();
    law.varying = varies;
  }
  return law;
}

FaceLaw law_of_step(const ChargingMembrane& of, double dt, const FaceCharges& charges) {
  const auto& [electric, membrane] = of.in_field;
  if (charges_by_place(membrane)) {
    return law_of_step(of, membrane_current(electric, of.charging, membrane), dt, charges);
  }
  const double c = of.charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  return {c / dt + of.charging.conductance, electric.conductivity_in + in / dt, electric.conductivity_out + out / dt,
          (c / dt) * charges.inner, (c / dt) * (charges.sum - charges.inner)};
}

FaceLaw law_of_step(const ChargingMembrane& of, const MembraneCurrent& current, double dt, const FaceCharges& charges) {
  const auto& [electric, membrane] = of.in_field;
  const double c = of.charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  Vector a = capacitance_of(of.charging, membrane) / dt + current.conductance;
  const Vector constant = membrane.fine.analyze(current.constant);
  const double largest = a.maxCoeff();
  return {largest,
          electric.conductivity_in + in / dt,
          electric.conductivity_out + out / dt,
          (c / dt) * charges.inner - constant,
          (c / dt) * (charges.sum - charges.inner) + constant,
          std::move(a)};
}

ElectricParameters conducting(const ElectricParameters& electric, const FaceLaw& law) {
  ElectricParameters of_law = electric;
  of_law.conductivity_in = law.k_in;
  of_law.conductivity_out = law.k_out;
  return of_law;
}

Vector right_side_of(const ElectricParameters& of_law, const Membrane& membrane, const ChargingEquation& equation,
                     const FaceLaw& law) {
  const SphereTransform& fine = membrane.fine;
  Vector rhs = fine.analyze(weighted_field_flux(membrane, of_law.field)) +
               half_and_adjoint(membrane, -1.0, law.s_in / law.k_in) -
               half_and_adjoint(membrane, 1.0, law.s_out / law.k_out);
  rhs *= equation.conduction();
  const double over_size = equation.conduction() / series_conductivity(of_law);
  rhs[0] = over_size * membrane.weighted(fine.synthesize(law.s_in))(0, 0);
  return rhs;
}

SolveReport solve_law(const ElectricMembrane& of, const FaceLaw& law, double tolerance, Vector& potential) {
  const Membrane& membrane = of.membrane;
  const ElectricParameters of_law = conducting(of.electric, law);
  const bool varies = law.varying.size() > 0;
  const ChargingEquation equation =
      varies ? ChargingEquation(of_law, membrane, law.varying) : ChargingEquation(of_law, membrane, law.a);
  const Vector rhs = right_side_of(of_law, membrane, equation, law);
  if (potential.size() != rhs.size()) potential = Vector::Zero(rhs.size());
  const LinearMap map = [&](const Vector& v) { return equation.own(v); };
  const LinearMap preconditioner = [&](const Vector& r) { return equation.sphere_inverse(r); };
  return solve_within(membrane.subspace.potentials(), map, preconditioner, rhs, potential,
                      {tolerance, varies ? 120 : 60});
}

FaceCharges charges_after(const ChargingMembrane& of, const FaceLaw& law, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  const double c = of.charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  Vector field_in, field_out;
  if (law.varying.size() == 0) {
    field_in = (law.a * potential - law.s_in) / law.k_in;
    field_out = (law.a * potential + law.s_out) / law.k_out;
  } else {
    const Vector stored = product(membrane, law.varying, potential);
    field_in = (stored - law.s_in) / law.k_in;
    field_out = (stored + law.s_out) / law.k_out;
  }
  return {capacitive(of, potential) - (in / c) * field_in, (out / c) * field_out - (in / c) * field_in};
}

Vector weighted_field_jump(const ChargingMembrane& of, const FaceCharges& charges, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  const double c = of.charging.capacitance, in = permittivity_in(electric), out = electric.permittivity;
  const Vector stored = capacitive(of, potential);
  const Vector difference = (c / out) * (stored + charges.sum - charges.inner) - (c / in) * (stored - charges.inner);
  return membrane.weighted(membrane.fine.synthesize(difference));
}

ElectricTraces traces_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                                 const Membrane& membrane, const FaceCharges& charges, const Vector& potential,
                                 const Vector& weighted_jump, const Vector& flux_of_others, const Vector& of_others) {
  const SphereTransform& fine = membrane.fine;
  const double in = permittivity_in(electric), out = electric.permittivity;
  const Vector smoothed = fine.synthesize(membrane.layers.laplace_adjoint.apply(weighted_jump));
  Vector weighted_mean =
      weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential) - smoothed;
  if (flux_of_others.size() > 0) weighted_mean += fine.synthesize(flux_of_others);
  const Vector mean = weighted_mean.cwiseQuotient(membrane.surface.area_element);
  const Vector free = charging.capacitance * fine.synthesize(charges.sum);
  const Vector jump = (2.0 / (in + out)) * ((in - out) * mean + free);
  ElectricTraces traces;
  traces.flux_in = 0.5 * jump - mean;
  traces.flux_out = -0.5 * jump - mean;
  traces.charge = jump;
  const Vector applied = fine.analyze(-(membrane.surface.position * electric.field));
  Vector between = applied - Vector(membrane.layers.laplace_double.apply(potential)) +
                   Vector(membrane.layers.laplace_single.apply(weighted_jump));
  if (of_others.size() > 0) between += of_others;
  traces.potential_in = between + 0.5 * potential;
  traces.potential_out = between - 0.5 * potential;
  return traces;
}

RelaxingField field_of_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                               const Membrane& membrane, const FaceCharges& charges, double tolerance,
                               const Vector& start) {
  const ChargingMembrane of{{electric, membrane}, charging};
  RelaxingField field;
  field.potential = start;
  field.report = solve_law(of.in_field, law_of_charges(of, charges), tolerance, field.potential);
  const Vector jump = weighted_field_jump(of, charges, field.potential);
  field.traces = traces_of_charges(electric, charging, membrane, charges, field.potential, jump);
  return field;
}

FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field) {
  return charge_rates(electric, charging, membrane, field,
                      current_through(electric, charging, membrane, field.potential));
}

FaceCharges charge_rates(const ElectricParameters& electric, const ChargingParameters& charging,
                         const Membrane& membrane, const RelaxingField& field, const Vector& current) {
  const Vector in = without_mean(membrane, -electric.conductivity_in * field.traces.flux_in);
  const Vector out = without_mean(membrane, -electric.conductivity_out * field.traces.flux_out);
  return {(Vector(membrane.fine.analyze(in)) - current) / charging.capacitance,
          Vector(membrane.fine.analyze(Vector(in - out))) / charging.capacitance};
}

SolveReport relax_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                          const Membrane& membrane, double dt, double tolerance, FaceCharges& charges) {
  const ChargingMembrane of{{electric, membrane}, charging};
  const FaceLaw law = law_of_step(of, dt, charges);
  Vector potential = charges.inner;
  const SolveReport report = solve_law(of.in_field, law, tolerance, potential);
  charges = charges_after(of, law, potential);
  return report;
}

FaceCharges steady_charges(const ElectricParameters& electric, const ChargingParameters& charging,
                           const Membrane& membrane, const Vector& potential) {
  if (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0) {
    throw InputError(
        "a steady V_m with displacement currents needs fluids that both conduct; one conductivity is zero");
  }
  if (charges_by_place(membrane)) {
    const Vector current = current_through(electric, charging, membrane, potential) / charging.capacitance;
    const double in = permittivity_in(electric) / electric.conductivity_in;
    const double out = electric.permittivity / electric.conductivity_out;
    return {capacitive({{electric, membrane}, charging}, potential) - in * current, (out - in) * current};
  }
  const double leak = charging.conductance / charging.capacitance;
  const double in = permittivity_in(electric) / electric.conductivity_in * leak;
  const double out = electric.permittivity / electric.conductivity_out * leak;
  return {(1.0 - in) * potential, (out - in) * potential};
}

}  // namespace vehd
