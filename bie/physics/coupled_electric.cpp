#include "bie/physics/coupled_electric.hpp"

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// η_b times each density, empty where that is nothing or unknown.
std::vector<Vector> charges_of(const std::vector<ElectricMembrane>& membranes, const std::vector<Vector>& weighted) {
  std::vector<Vector> charges;
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    const double eta = conductivity_contrast(membranes[b].electric);
    charges.push_back(eta == 0.0 ? Vector() : Vector(eta * weighted[b]));
  }
  return charges;
}

/// Σ_b η_b S′_ab of a ≠ b.
std::vector<Vector> fluxes_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                     const std::vector<Vector>& weighted) {
  return interaction.weighted_single_flux(charges_of(membranes, weighted));
}

}  // namespace

PairSelection electric_pair_selection(const ElectricParameters& electric) {
  const bool charged = carries_charge(electric);
  return {.laplace_single = charged,
          .laplace_single_normal = charged,
          .laplace_double = true,
          .laplace_double_normal = true};
}

std::vector<Vector> weighted_fluxes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                    const std::vector<Vector>& potentials) {
  const std::vector<Vector> of_others = interaction.weighted_double_flux(potentials);
  std::vector<Vector> fluxes(membranes.size());
  for_each_member(interaction.shares().own(membranes.size()), [&](std::size_t a) {
    const Membrane& membrane = membranes[a].membrane;
    fluxes[a] = weighted_field_flux(membrane, membranes[a].electric.field) +
                weighted_hypersingular(membrane, potentials[a]) + membrane.fine.synthesize(of_others[a]);
  });
  return fluxes;
}

CoupledDensities solve_second_kind(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                   const std::vector<Vector>& weighted_rhs, double tolerance) {
  const std::size_t n = membranes.size();
  std::vector<Index> sizes;
  std::vector<std::vector<Index>> entries;
  std::vector<double> etas, areas;
  std::vector<Vector> right_sides(n);
  const Shares& shares = interaction.shares();
  const std::vector<std::size_t> own = shares.own(n);
  for (std::size_t a = 0; a < n; ++a) {
    const Membrane& membrane = membranes[a].membrane;
    sizes.push_back(n_coefficients(membrane.fine.order()));
    entries.push_back(membrane.subspace.potentials());
    etas.push_back(conductivity_contrast(membranes[a].electric));
    areas.push_back(membrane.radius * membrane.radius);
  }
  for (const std::size_t a : own) right_sides[a] = second_kind_right_side(membranes[a].membrane, weighted_rhs[a]);
  interaction.gather_potentials(right_sides);
  const StackedEntries stacked(std::move(sizes), std::move(entries));
  const Vector scale = stacked.spread(areas);
  const auto densities_of = [&](const Vector& unknowns) { return stacked.parts(unknowns.cwiseProduct(scale)); };
  const LinearMap map = [&](const Vector& unknowns) {
    const std::vector<Vector> weighted = densities_of(unknowns);
    std::vector<Vector> result = fluxes_of_others(membranes, interaction, weighted);
    for_each_member(
        own, [&](std::size_t a) { result[a] += second_kind_operator(membranes[a].membrane, etas[a], weighted[a]); });
    interaction.gather_potentials(result);
    return stacked.stack(result);
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<Vector> parts = stacked.parts(residual);
    for (std::size_t a = 0; a < n; ++a) parts[a] = second_kind_sphere_inverse(etas[a], parts[a]);
    return stacked.stack(parts).cwiseQuotient(scale);
  };
  RecycledGcr solver(map, preconditioner, stacked.size());
  const RecycledGcr::Solution solution = solver.solve(stacked.stack(right_sides), {}, {tolerance, 60});

  CoupledDensities result{{}, solution.report};
  const std::vector<Vector> weighted = densities_of(solution.x);
  const std::vector<Vector> of_others = fluxes_of_others(membranes, interaction, weighted);
  for (std::size_t a = 0; a < n; ++a) {
    SecondKindSolution& density = result.membranes.emplace_back(SecondKindSolution{weighted[a], {}, solution.report});
    if (!shares.owns(a)) continue;
    const Membrane& membrane = membranes[a].membrane;
    Vector smoothed = of_others[a];
    if (etas[a] != 0.0) smoothed += etas[a] * membrane.layers.laplace_adjoint.apply(weighted[a]);
    density.values = (2.0 * (weighted_rhs[a] - Vector(membrane.fine.synthesize(smoothed))))
                         .cwiseQuotient(membrane.surface.area_element);
  }
  return result;
}

std::vector<Vector> potentials_of_others(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                         const std::vector<Vector>& potentials,
                                         const std::vector<SecondKindSolution>& densities) {
  std::vector<Vector> weighted;
  for (const SecondKindSolution& density : densities) weighted.push_back(density.weighted);
  std::vector<Vector> result = interaction.single_potential(charges_of(membranes, weighted));
  const std::vector<Vector> jumps = interaction.double_potential(potentials);
  for (const std::size_t a : interaction.shares().own(result.size())) result[a] -= jumps[a];
  return result;
}

}  // namespace vehd
