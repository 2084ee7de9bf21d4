#include "bie/physics/law_traces.hpp"

#include "bie/physics/real_maps.hpp"

namespace vehd {

namespace {

/// What the layers of all other membranes do to one; empty without others.
template <typename Scalar>
struct OfOthers {
  FieldOf<Scalar> flux;       // J n·∇ of their double layers less their single layers, coefficients
  FieldOf<Scalar> potential;  // of their single layers less their double layers, coefficients
};

template <typename Scalar>
std::vector<OfOthers<Scalar>> layers_of_others(const Interaction& interaction,
                                               const std::vector<FieldOf<Scalar>>& potentials,
                                               const std::vector<FieldOf<Scalar>>& weighted_jumps) {
  std::vector<OfOthers<Scalar>> result(potentials.size());
  if (interaction.is_empty()) return result;
  const auto double_flux = of_others<Scalar>(interaction, &Interaction::weighted_double_flux, potentials);
  const auto single_flux = of_others<Scalar>(interaction, &Interaction::weighted_single_flux, weighted_jumps);
  const auto of_double = of_others<Scalar>(interaction, &Interaction::double_potential, potentials);
  const auto of_single = of_others<Scalar>(interaction, &Interaction::single_potential, weighted_jumps);
  for (const std::size_t a : interaction.shares().own(result.size())) {
    result[a] = {double_flux[a] - single_flux[a], of_single[a] - of_double[a]};
  }
  return result;
}

/// @param weighted_jump  J (E_e − E_i), coefficients; empty where it is zero
template <typename Scalar>
TracesOf<Scalar> traces_of(const ElectricMembrane& of, const CurrentLaw<Scalar>& law, const FieldOf<Scalar>& potential,
                           const FieldOf<Scalar>& weighted_jump, const OfOthers<Scalar>& others) {
  const Membrane& membrane = of.membrane;
  FieldOf<Scalar> weighted_mean = applied_flux<Scalar>(of) + hypersingular<Scalar>(membrane, potential);
  const Vector applied = membrane.fine.analyze(-(membrane.surface.position * of.electric.field));
  FieldOf<Scalar> between =
      applied.cast<Scalar>() -
      mapped<Scalar>([&](const Matrix& parts) -> Matrix { return membrane.layers.laplace_double.apply(parts); },
                     potential);
  if (weighted_jump.size() > 0) {
    weighted_mean -= values_of<Scalar>(membrane, adjoint<Scalar>(membrane, weighted_jump));
    between += mapped<Scalar>(
        [&](const Matrix& parts) -> Matrix { return membrane.layers.laplace_single.apply(parts); }, weighted_jump);
  }
  if (others.flux.size() > 0) {
    weighted_mean += values_of<Scalar>(membrane, others.flux);
    between += others.potential;
  }
  const FieldOf<Scalar> mean = weighted_mean.cwiseQuotient(membrane.surface.area_element.cast<Scalar>());
  TracesOf<Scalar> traces;
  traces.charge = 2.0 * law.contrast() * mean + (2.0 / (law.k_in + law.k_out)) * (law.s_in + law.s_out);
  traces.flux_in = 0.5 * traces.charge - mean;
  traces.flux_out = -0.5 * traces.charge - mean;
  traces.potential_in = between + 0.5 * potential;
  traces.potential_out = between - 0.5 * potential;
  return traces;
}

}  // namespace

template <typename Scalar>
std::vector<TracesOf<Scalar>> traces_of_laws(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction,
                                             const std::vector<CurrentLaw<Scalar>>& laws,
                                             const std::vector<FieldOf<Scalar>>& potentials) {
  const std::vector<std::size_t> own = interaction.shares().own(membranes.size());
  std::vector<FieldOf<Scalar>> jumps(membranes.size());
  for (const std::size_t a : own) {
    if (!carries_charge(membranes[a].in_field.electric)) continue;
    const Membrane& membrane = membranes[a].in_field.membrane;
    const FieldsAtFaces<Scalar> fields = fields_of(laws[a], membrane, potentials[a]);
    jumps[a] = weighted<Scalar>(membrane, fields.out - fields.in);
  }
  const std::vector<OfOthers<Scalar>> others = layers_of_others<Scalar>(interaction, potentials, jumps);
  std::vector<TracesOf<Scalar>> traces(membranes.size());
  for (const std::size_t a : own) {
    traces[a] = traces_of<Scalar>(membranes[a].in_field, laws[a], potentials[a], jumps[a], others[a]);
  }
  return traces;
}

using Complex = std::complex<double>;
template std::vector<TracesOf<double>> traces_of_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                                      const std::vector<CurrentLaw<double>>&,
                                                      const std::vector<FieldOf<double>>&);
template std::vector<TracesOf<Complex>> traces_of_laws(const std::vector<ChargingMembrane>&, const Interaction&,
                                                       const std::vector<CurrentLaw<Complex>>&,
                                                       const std::vector<FieldOf<Complex>>&);

}  // namespace vehd
