#include "bie/physics/coupled_equation.hpp"

#include <algorithm>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

CoupledEquation::CoupledEquation(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                 const std::vector<Storage>& storages)
    : membranes_(membranes),
      interaction_(interaction),
      storages_(storages),
      owned_(interaction.shares().own(membranes.size())) {
  for (std::size_t b = 0; b < membranes.size(); ++b) {
    const ElectricParameters& electric = membranes[b].electric;
    const double a = storages[b].a;
    if (storages[b].varying.size() > 0) {
      own_.emplace_back(electric, membranes[b].membrane, storages[b].varying);
    } else {
      own_.emplace_back(electric, membranes[b].membrane, a);
    }
    const double eta = conductivity_contrast(electric);
    const double kappa = series_conductivity(electric);
    if (kappa == 0.0 && a > 0.0) {
      throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
    }
    // Without a there is no g.
    charge_.push_back(a > 0.0 ? eta / kappa * a : 0.0);
    charge_of_current_.push_back(a > 0.0 ? eta / kappa : 0.0);
  }
}

std::vector<Vector> CoupledEquation::left_side(const std::vector<Vector>& potentials) const {
  std::vector<Vector> charges(potentials.size());
  for (const std::size_t b : owned_) {
    const Vector& varying = storages_[b].varying;
    if (varying.size() > 0) {
      const Vector values = membranes_[b].membrane.fine.synthesize(potentials[b]);
      charges[b] = weighted_values(b, charge_of_current_[b], varying.cwiseProduct(values));
    } else {
      charges[b] = weighted(b, charge_[b], potentials[b]);
    }
  }
  std::vector<Vector> result = interaction_.weighted_single_flux(charges);
  const std::vector<Vector> of_potentials = interaction_.weighted_double_flux(potentials);
  for_each_member(owned_, [&](std::size_t a) {
    result[a] = own_[a].conduction() * (result[a] - of_potentials[a]) + own_[a].own(potentials[a]);
  });
  interaction_.gather_potentials(result);
  return result;
}

std::vector<Vector> CoupledEquation::right_sides(const std::vector<Vector>& of_own,
                                                 const std::vector<Vector>& charges) const {
  std::vector<Vector> result = interaction_.weighted_single_flux(charges);
  for (const std::size_t a : owned_) result[a] = own_[a].conduction() * result[a] + of_own[a];
  interaction_.gather_potentials(result);
  return result;
}

Vector CoupledEquation::weighted(std::size_t a, double factor, const Vector& field) const {
  const Membrane& membrane = membranes_[a].membrane;
  const bool none = factor == 0.0 || field.isZero(0.0);
  return none ? Vector() : Vector(factor * membrane.weighted(membrane.fine.synthesize(field)));
}

Vector CoupledEquation::weighted_values(std::size_t a, double factor, const Vector& values) const {
  const bool none = factor == 0.0 || values.isZero(0.0);
  return none ? Vector() : Vector(factor * membranes_[a].membrane.weighted(values));
}

SolveReport CoupledEquation::solve(const std::vector<Vector>& rhs, double tolerance,
                                   std::vector<Vector>& potentials) const {
  std::vector<Index> sizes;
  std::vector<std::vector<Index>> entries;
  std::vector<double> radii;
  for (const ElectricMembrane& one : membranes_) {
    sizes.push_back(n_coefficients(one.membrane.fine.order()));
    entries.push_back(one.membrane.subspace.potentials());
    radii.push_back(one.membrane.radius);
  }
  const StackedEntries stacked(std::move(sizes), std::move(entries));
  const Vector scale = stacked.spread(radii);
  const LinearMap map = [&](const Vector& unknowns) {
    return stacked.stack(left_side(stacked.parts(unknowns.cwiseProduct(scale))));
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<Vector> parts = stacked.parts(residual);
    for (std::size_t a = 0; a < parts.size(); ++a) parts[a] = own_[a].sphere_inverse(parts[a]);
    return stacked.stack(parts).cwiseQuotient(scale);
  };
  RecycledGcr solver(map, preconditioner, stacked.size());
  const Vector start = stacked.stack(potentials).cwiseQuotient(scale);
  // The inverse on a sphere knows the mean of a alone.
  const bool varies =
      std::any_of(storages_.begin(), storages_.end(), [](const Storage& one) { return one.varying.size() > 0; });
  const RecycledGcr::Solution solution = solver.solve(stacked.stack(rhs), start, {tolerance, varies ? 120 : 60});
  potentials = stacked.parts(solution.x.cwiseProduct(scale));
  return solution.report;
}

}  // namespace vehd
