#include "bie/physics/coupled_charging.hpp"

#include <limits>

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// a V − b of one membrane.
struct Storage {
  double a = 0.0;     ///< C_m/dt + G_m, or its largest value
  Vector b;           ///< coefficients; empty where both vary
  ChargingStep vary;  ///< a and b that differ from place to place; empty where they do not
  [[nodiscard]] bool varies() const { return vary.a.size() > 0; }
};

/// The equations of all membranes.
class CoupledEquation {
 public:
  CoupledEquation(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                  const std::vector<Storage>& storages)
      : membranes_(membranes),
        interaction_(interaction),
        storages_(storages),
        owned_(interaction.shares().own(membranes.size())) {
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      const ElectricParameters& electric = membranes[b].electric;
      const double a = storages[b].a;
      if (storages[b].varies()) {
        own_.emplace_back(electric, membranes[b].membrane, storages[b].vary.a);
      } else {
        own_.emplace_back(electric, membranes[b].membrane, a);
      }
      const double eta = conductivity_contrast(electric);
      const double kappa = series_conductivity(electric);
      if (kappa == 0.0 && a > 0.0) {
        throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
      }
      // η g over V; without a there is no g.
      charge_.push_back(a > 0.0 ? eta / kappa * a : 0.0);
      charge_of_b_.push_back(a > 0.0 ? eta / kappa : 0.0);
    }
  }

  [[nodiscard]] std::vector<Vector> left_side(const std::vector<Vector>& potentials) const {
    std::vector<Vector> charges(potentials.size());
    for (const std::size_t b : owned_) {
      charges[b] = storages_[b].varies() ? of_values(b, storages_[b].vary.a.cwiseProduct(values_of(b, potentials[b])))
                                         : of_coefficients(b, charge_[b], potentials[b]);
    }
    std::vector<Vector> result = interaction_.weighted_single_flux(charges);
    const std::vector<Vector> of_potentials = interaction_.weighted_double_flux(potentials);
    for (const std::size_t a : owned_) {
      result[a] = own_[a].conduction() * (result[a] - of_potentials[a]) + own_[a].own(potentials[a]);
    }
    interaction_.shares().gather(result);
    return result;
  }

  [[nodiscard]] std::vector<Vector> right_side() const {
    std::vector<Vector> charges(storages_.size());
    for (const std::size_t b : owned_) {
      const Storage& storage = storages_[b];
      charges[b] = storage.varies() ? of_values(b, storage.vary.b) : of_coefficients(b, charge_of_b_[b], storage.b);
    }
    std::vector<Vector> result = interaction_.weighted_single_flux(charges);
    for (const std::size_t a : owned_) {
      const Storage& storage = storages_[a];
      result[a] = own_[a].conduction() * result[a] +
                  (storage.varies() ? own_[a].right_side_of_values(storage.vary.b) : own_[a].right_side(storage.b));
    }
    interaction_.shares().gather(result);
    return result;
  }

  [[nodiscard]] Vector sphere_inverse(std::size_t a, const Vector& residual) const {
    return own_[a].sphere_inverse(residual);
  }

 private:
  [[nodiscard]] Vector values_of(std::size_t b, const Vector& coefficients) const {
    return membranes_[b].membrane.fine.synthesize(coefficients);
  }

  /// J times a multiple of a field; empty where there is nothing.
  [[nodiscard]] Vector of_coefficients(std::size_t b, double factor, const Vector& field) const {
    const Membrane& membrane = membranes_[b].membrane;
    const bool none = factor == 0.0 || field.isZero(0.0);
    return none ? Vector() : Vector(factor * membrane.weighted(membrane.fine.synthesize(field)));
  }

  /// J η/κ times values.
  [[nodiscard]] Vector of_values(std::size_t b, const Vector& values) const {
    const bool none = charge_of_b_[b] == 0.0 || values.isZero(0.0);
    return none ? Vector() : Vector(charge_of_b_[b] * membranes_[b].membrane.weighted(values));
  }

  const std::vector<ElectricMembrane>& membranes_;
  const Interaction& interaction_;
  const std::vector<Storage>& storages_;
  std::vector<std::size_t> owned_;  ///< membranes of this rank
  std::vector<ChargingEquation> own_;
  std::vector<double> charge_, charge_of_b_;
};

/// The unknowns are V/R: what a field of one size makes of membranes of any size.
SolveReport solve_charging(const std::vector<ElectricMembrane>& membranes, const CoupledEquation& equation,
                           double tolerance, std::vector<Vector>& potentials) {
  std::vector<Index> sizes;
  std::vector<std::vector<Index>> entries;
  std::vector<double> radii;
  for (const ElectricMembrane& one : membranes) {
    sizes.push_back(n_coefficients(one.membrane.fine.order()));
    entries.push_back(one.membrane.subspace.potentials());
    radii.push_back(one.membrane.radius);
  }
  const StackedEntries stacked(std::move(sizes), std::move(entries));
  const Vector scale = stacked.spread(radii);
  const LinearMap map = [&](const Vector& unknowns) {
    return stacked.stack(equation.left_side(stacked.parts(unknowns.cwiseProduct(scale))));
  };
  const LinearMap preconditioner = [&](const Vector& residual) -> Vector {
    std::vector<Vector> parts = stacked.parts(residual);
    for (std::size_t a = 0; a < parts.size(); ++a) parts[a] = equation.sphere_inverse(a, parts[a]);
    return stacked.stack(parts).cwiseQuotient(scale);
  };
  RecycledGcr solver(map, preconditioner, stacked.size());
  const Vector start = stacked.stack(potentials).cwiseQuotient(scale);
  const RecycledGcr::Solution solution = solver.solve(stacked.stack(equation.right_side()), start, {tolerance, 60});
  potentials = stacked.parts(solution.x.cwiseProduct(scale));
  return solution.report;
}

}  // namespace

namespace {

/// Where something differs from place to place.
Storage varying(const ElectricMembrane& one, const ChargingParameters& charging, double dt, const Vector& potential) {
  Storage storage{0.0, {}, charging_step(one.electric, charging, one.membrane, dt, potential)};
  storage.a = storage.vary.a.maxCoeff();
  return storage;
}

}  // namespace

SolveReport charge_membranes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                             const std::vector<ChargingParameters>& charging, double dt, double tolerance,
                             std::vector<Vector>& potentials) {
  std::vector<Storage> storages;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    const double capacitive = charging[i].capacitance / dt;
    storages.push_back(charges_by_place(membranes[i].membrane)
                           ? varying(membranes[i], charging[i], dt, potentials[i])
                           : Storage{capacitive + charging[i].conductance, capacitive * potentials[i], {}});
  }
  return solve_charging(membranes, {membranes, interaction, storages}, tolerance, potentials);
}

SolveReport steady_potentials(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                              const std::vector<ChargingParameters>& charging, double tolerance,
                              std::vector<Vector>& potentials) {
  std::vector<Storage> storages;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    if (charging[i].conductance == 0.0 && series_conductivity(membranes[i].electric) == 0.0) {
      throw InputError(
          "a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
    }
    const Vector none = Vector::Zero(n_coefficients(membranes[i].membrane.fine.order()));
    if (potentials[i].size() == 0) potentials[i] = none;
    const Storage uniform{charging[i].conductance, none, {}};
    const bool by_place = charges_by_place(membranes[i].membrane);
    storages.push_back(by_place
                           ? varying(membranes[i], charging[i], std::numeric_limits<double>::infinity(), potentials[i])
                           : uniform);
    if (by_place && storages.back().a == 0.0) {
      if (membranes[i].membrane.material.pump_current.size() > 0) {
        throw InputError("a steady V_m is not determined: a pump works on a membrane that does not conduct");
      }
      storages.back() = uniform;
    }
  }
  return solve_charging(membranes, {membranes, interaction, storages}, tolerance, potentials);
}

}  // namespace vehd
