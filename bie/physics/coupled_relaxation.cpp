#include "bie/physics/coupled_relaxation.hpp"

#include <utility>

#include "bie/physics/coupled_equation.hpp"

namespace vehd {

namespace {

/// Of the double layers less the single layers of all other membranes, on those of this rank.
std::vector<Vector> difference(const std::vector<std::size_t>& own, std::vector<Vector> doubles,
                               const std::vector<Vector>& singles) {
  for (const std::size_t a : own) doubles[a] -= singles[a];
  return doubles;
}

}  // namespace

SolveReport solve_laws(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction,
                       const std::vector<FaceLaw>& laws, double tolerance, std::vector<Vector>& potentials) {
  std::vector<ElectricMembrane> of_laws;
  std::vector<Storage> storages;
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    const auto& [electric, membrane] = membranes[b].in_field;
    of_laws.push_back({conducting(electric, laws[b]), membrane});
    storages.push_back({laws[b].a, laws[b].varying});
  }
  const CoupledEquation equation(of_laws, interaction, storages);
  std::vector<Vector> of_own(membranes.size()), charges(membranes.size());
  for (const std::size_t b : interaction.shares().own(membranes.size())) {
    const FaceLaw& law = laws[b];
    of_own[b] = right_side_of(of_laws[b].electric, of_laws[b].membrane, equation.own(b), law);
    // E_e − E_i where V is zero, on the right.
    charges[b] = equation.weighted(b, -1.0, law.s_in / law.k_in + law.s_out / law.k_out);
  }
  return equation.solve(equation.right_sides(of_own, charges), tolerance, potentials);
}

std::vector<RelaxingField> fields_of_charges(const std::vector<ChargingMembrane>& membranes,
                                             const Interaction& interaction, const std::vector<FaceCharges>& charges,
                                             double tolerance, std::vector<Vector> start) {
  std::vector<FaceLaw> laws;
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    laws.push_back(law_of_charges(membranes[b], charges[b]));
  }
  std::vector<Vector> potentials = std::move(start);
  const SolveReport report = solve_laws(membranes, interaction, laws, tolerance, potentials);
  const std::vector<std::size_t> own = interaction.shares().own(membranes.size());
  std::vector<Vector> jumps(membranes.size());
  for (const std::size_t b : own) {
    jumps[b] = weighted_field_jump(membranes[b], charges[b], potentials[b]);
  }
  const std::vector<Vector> fluxes =
      difference(own, interaction.weighted_double_flux(potentials), interaction.weighted_single_flux(jumps));
  const std::vector<Vector> minus_of_others =
      difference(own, interaction.double_potential(potentials), interaction.single_potential(jumps));
  std::vector<RelaxingField> fields;
  for (const Vector& potential : potentials) fields.push_back({potential, {}, report});
  for (const std::size_t a : own) {
    const auto& [electric, membrane] = membranes[a].in_field;
    fields[a].traces = traces_of_charges(electric, membranes[a].charging, membrane, charges[a], potentials[a], jumps[a],
                                         fluxes[a], -minus_of_others[a]);
  }
  return fields;
}

SolveReport relax_charges(const std::vector<ChargingMembrane>& membranes, const Interaction& interaction, double dt,
                          double tolerance, std::vector<FaceCharges>& charges) {
  std::vector<FaceLaw> laws;
  std::vector<Vector> potentials;
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    laws.push_back(law_of_step(membranes[b], dt, charges[b]));
    potentials.push_back(charges[b].inner);
  }
  const SolveReport report = solve_laws(membranes, interaction, laws, tolerance, potentials);
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    charges[b] = charges_after(membranes[b], laws[b], potentials[b]);
  }
  return report;
}

}  // namespace vehd
