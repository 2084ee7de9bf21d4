#include "bie/physics/coupled_charging.hpp"

#include "bie/linear/recycled_gcr.hpp"
#include "bie/linear/stacked_entries.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// The equations of all membranes.
class CoupledEquation {
 public:
  /// @param a  C_m/dt + G_m of each
  CoupledEquation(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                  const std::vector<double>& a)
      : membranes_(membranes), interaction_(interaction) {
    for (std::size_t b = 0; b < membranes.size(); ++b) {
      const ElectricParameters& electric = membranes[b].electric;
      own_.emplace_back(electric, membranes[b].membrane, a[b]);
      const double eta = conductivity_contrast(electric);
      const double kappa = series_conductivity(electric);
      if (kappa == 0.0 && a[b] > 0.0) {
        throw InputError("several membranes charge between fluids that both conduct; one conductivity is zero");
      }
      // η g over V; without a there is no g.
      charge_.push_back(a[b] > 0.0 ? eta / kappa * a[b] : 0.0);
      charge_of_b_.push_back(a[b] > 0.0 ? eta / kappa : 0.0);
    }
  }

  [[nodiscard]] std::vector<Vector> left_side(const std::vector<Vector>& potentials) const {
    std::vector<Vector> result = interaction_.weighted_single_flux(charges(potentials, charge_));
    const std::vector<Vector> of_potentials = interaction_.weighted_double_flux(potentials);
    for (std::size_t a = 0; a < own_.size(); ++a) {
      result[a] = own_[a].conduction() * (result[a] - of_potentials[a]) + own_[a].own(potentials[a]);
    }
    return result;
  }

  [[nodiscard]] std::vector<Vector> right_side(const std::vector<Vector>& b) const {
    std::vector<Vector> result = interaction_.weighted_single_flux(charges(b, charge_of_b_));
    for (std::size_t a = 0; a < own_.size(); ++a) {
      result[a] = own_[a].conduction() * result[a] + own_[a].right_side(b[a]);
    }
    return result;
  }

  [[nodiscard]] Vector sphere_inverse(std::size_t a, const Vector& residual) const {
    return own_[a].sphere_inverse(residual);
  }

 private:
  /// J times multiples of the fields; empty where there is nothing.
  [[nodiscard]] std::vector<Vector> charges(const std::vector<Vector>& fields,
                                            const std::vector<double>& factors) const {
    std::vector<Vector> result;
    for (std::size_t b = 0; b < fields.size(); ++b) {
      const Membrane& membrane = membranes_[b].membrane;
      const bool none = factors[b] == 0.0 || fields[b].isZero(0.0);
      result.push_back(none ? Vector() : Vector(factors[b] * membrane.weighted(membrane.fine.synthesize(fields[b]))));
    }
    return result;
  }

  const std::vector<ElectricMembrane>& membranes_;
  const Interaction& interaction_;
  std::vector<ChargingEquation> own_;
  std::vector<double> charge_, charge_of_b_;
};

/// The unknowns are V/R: what a field of one size makes of membranes of any size.
SolveReport solve_charging(const std::vector<ElectricMembrane>& membranes, const CoupledEquation& equation,
                           const std::vector<Vector>& b, double tolerance, std::vector<Vector>& potentials) {
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
  const RecycledGcr::Solution solution = solver.solve(stacked.stack(equation.right_side(b)), start, {tolerance, 60});
  potentials = stacked.parts(solution.x.cwiseProduct(scale));
  return solution.report;
}

}  // namespace

SolveReport charge_membranes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                             const std::vector<ChargingParameters>& charging, double dt, double tolerance,
                             std::vector<Vector>& potentials) {
  std::vector<double> a;
  std::vector<Vector> b;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    const double capacitive = charging[i].capacitance / dt;
    a.push_back(capacitive + charging[i].conductance);
    b.emplace_back(capacitive * potentials[i]);
  }
  return solve_charging(membranes, {membranes, interaction, a}, b, tolerance, potentials);
}

SolveReport steady_potentials(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                              const std::vector<ChargingParameters>& charging, double tolerance,
                              std::vector<Vector>& potentials) {
  std::vector<double> a;
  std::vector<Vector> b;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    if (charging[i].conductance == 0.0 && series_conductivity(membranes[i].electric) == 0.0) {
      throw InputError(
          "a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
    }
    a.push_back(charging[i].conductance);
    b.emplace_back(Vector::Zero(n_coefficients(membranes[i].membrane.fine.order())));
    if (potentials[i].size() == 0) potentials[i] = b.back();
  }
  return solve_charging(membranes, {membranes, interaction, a}, b, tolerance, potentials);
}

}  // namespace vehd
