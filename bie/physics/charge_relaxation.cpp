#include "bie/physics/charge_relaxation.hpp"

#include <utility>

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

double permittivity_in(const ElectricParameters& electric) {
  return electric.permittivity_ratio * electric.permittivity;
}

Vector without_mean(const Membrane& membrane, Vector values) {
  const Vector& area = membrane.surface.quadrature;
  values.array() -= values.dot(area) / area.sum();
  return values;
}

/// E_i and E_e for a V, values on the upsampled grid.
struct FieldsAtFaces {
  Vector in, out;
};

FieldsAtFaces fields_of(const CurrentLaw& law, const Membrane& membrane, const Vector& potential) {
  const Vector stored = law.a.cwiseProduct(Vector(membrane.fine.synthesize(potential)));
  return {(stored - law.s_in) / law.k_in, (stored + law.s_out) / law.k_out};
}

/// What the layers of all other membranes do to one.
struct OfOthers {
  Vector flux;       // J n·∇ of their double layers less their single layers, coefficients; empty without others
  Vector potential;  // of their single layers less their double layers, likewise
};

std::vector<OfOthers> layers_of_others(const Interaction* interaction, const std::vector<Vector>& potentials,
                                       const std::vector<Vector>& weighted_jumps) {
  std::vector<OfOthers> result(potentials.size());
  if (interaction == nullptr) return result;
  const std::vector<Vector> double_flux = interaction->weighted_double_flux(potentials);
  const std::vector<Vector> single_flux = interaction->weighted_single_flux(weighted_jumps);
  const std::vector<Vector> of_double = interaction->double_potential(potentials);
  const std::vector<Vector> of_single = interaction->single_potential(weighted_jumps);
  for (const std::size_t a : interaction->shares().own(result.size())) {
    result[a] = {double_flux[a] - single_flux[a], of_single[a] - of_double[a]};
  }
  return result;
}

/// Traces that go with V and with J (E_e − E_i), the single layer beside V in the potential. The mean of both fields is
/// found from the layers, which smooth: free of the truncation that C_m V − q_i would magnify.
ElectricTraces traces_of(const ChargingMembrane& of, const FaceCharges& charges, const Vector& potential,
                         const Vector& weighted_jump, const OfOthers& others) {
  const auto& [electric, membrane] = of.in_field;
  const SphereTransform& fine = membrane.fine;
  const double in = permittivity_in(electric), out = electric.permittivity;
  const Vector smoothed = fine.synthesize(membrane.layers.laplace_adjoint.apply(weighted_jump));
  Vector weighted_mean =
      weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential) - smoothed;
  if (others.flux.size() > 0) weighted_mean += fine.synthesize(others.flux);
  const Vector mean = weighted_mean.cwiseQuotient(membrane.surface.area_element);
  const Vector free = of.charging.capacitance * fine.synthesize(charges.sum);
  const Vector jump = (2.0 / (in + out)) * ((in - out) * mean + free);
  ElectricTraces traces;
  traces.flux_in = 0.5 * jump - mean;
  traces.flux_out = -0.5 * jump - mean;
  traces.charge = jump;
  const Vector applied = fine.analyze(-(membrane.surface.position * electric.field));
  Vector between = applied - Vector(membrane.layers.laplace_double.apply(potential)) +
                   Vector(membrane.layers.laplace_single.apply(weighted_jump));
  if (others.potential.size() > 0) between += others.potential;
  traces.potential_in = between + 0.5 * potential;
  traces.potential_out = between - 0.5 * potential;
  return traces;
}

std::vector<ElectricMembrane> in_field_of(const std::vector<ChargingMembrane>& membranes) {
  std::vector<ElectricMembrane> result;
  for (const ChargingMembrane& one : membranes) result.push_back(one.in_field);
  return result;
}

}  // namespace

CurrentLaw law_of_charges(const ChargingMembrane& of, const FaceCharges& charges) {
  const auto& [electric, membrane] = of.in_field;
  const double c = of.charging.capacitance;
  return {capacitance_of(of.charging, membrane), permittivity_in(electric), electric.permittivity,
          c * membrane.fine.synthesize(charges.inner), c * membrane.fine.synthesize(charges.sum - charges.inner)};
}

CurrentLaw law_of_step(const ChargingMembrane& of, const MembraneCurrent& current, double dt,
                       const FaceCharges& charges) {
  const auto& [electric, membrane] = of.in_field;
  const CurrentLaw held = law_of_charges(of, charges);
  return {held.a / dt + current.conductance, electric.conductivity_in + held.k_in / dt,
          electric.conductivity_out + held.k_out / dt, held.s_in / dt - current.constant,
          held.s_out / dt + current.constant};
}

FaceCharges charges_after(const ChargingMembrane& of, const CurrentLaw& law, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  const FieldsAtFaces fields = fields_of(law, membrane, potential);
  const Vector displaced_in = permittivity_in(electric) * fields.in, displaced_out = electric.permittivity * fields.out;
  const Vector stored = capacitance_of(of.charging, membrane).cwiseProduct(Vector(membrane.fine.synthesize(potential)));
  const double c = of.charging.capacitance;
  return {membrane.fine.analyze(Vector(stored - displaced_in)) / c,
          membrane.fine.analyze(Vector(displaced_out - displaced_in)) / c};
}

std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction* interaction, const std::vector<FaceCharges>& charges,
                                             double tolerance, std::vector<Vector> start) {
  std::vector<CurrentLaw> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) laws.push_back(law_of_charges(membranes[a], charges[a]));
  std::vector<Vector> potentials = std::move(start);
  const SolveReport report = solve_laws(in_field_of(membranes), interaction, laws, tolerance, potentials);
  const Shares shares = interaction != nullptr ? interaction->shares() : Shares();
  const std::vector<std::size_t> own = shares.own(membranes.size());
  std::vector<Vector> jumps(membranes.size());
  for (const std::size_t a : own) {
    const Membrane& membrane = membranes[a].in_field.membrane;
    const FieldsAtFaces fields = fields_of(laws[a], membrane, potentials[a]);
    jumps[a] = membrane.weighted(fields.out - fields.in);
  }
  const std::vector<OfOthers> others = layers_of_others(interaction, potentials, jumps);
  std::vector<RelaxingField> fields;
  for (const Vector& potential : potentials) fields.push_back({potential, {}, report});
  for (const std::size_t a : own) {
    fields[a].traces = traces_of(membranes[a], charges[a], potentials[a], jumps[a], others[a]);
  }
  return fields;
}

FaceCharges charge_rates(const ChargingMembrane& of, const RelaxingField& field, const Vector& current) {
  const auto& [electric, membrane] = of.in_field;
  const Vector in = without_mean(membrane, -electric.conductivity_in * field.traces.flux_in);
  const Vector out = without_mean(membrane, -electric.conductivity_out * field.traces.flux_out);
  const double c = of.charging.capacitance;
  return {membrane.fine.analyze(Vector(in - current)) / c, membrane.fine.analyze(Vector(in - out)) / c};
}

SolveReport relax_charges(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                          double tolerance, std::vector<FaceCharges>& charges) {
  std::vector<CurrentLaw> laws;
  std::vector<Vector> potentials;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    laws.push_back(law_of_step(membranes[a], membrane_current(membranes[a]), dt, charges[a]));
    potentials.push_back(charges[a].inner);
  }
  const SolveReport report = solve_laws(in_field_of(membranes), interaction, laws, tolerance, potentials);
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    charges[a] = charges_after(membranes[a], laws[a], potentials[a]);
  }
  return report;
}

FaceCharges steady_charges(const ChargingMembrane& of, const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  if (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0) {
    throw InputError(
        "a steady V_m with displacement currents needs fluids that both conduct; one conductivity is zero");
  }
  const Vector current = current_through(membrane, membrane_current(of), potential);
  const Vector stored = capacitance_of(of.charging, membrane).cwiseProduct(Vector(membrane.fine.synthesize(potential)));
  const double in = permittivity_in(electric) / electric.conductivity_in;
  const double out = electric.permittivity / electric.conductivity_out;
  const double c = of.charging.capacitance;
  return {membrane.fine.analyze(Vector(stored - in * current)) / c,
          membrane.fine.analyze(Vector((out - in) * current)) / c};
}

}  // namespace vehd
