#include "bie/physics/coupled_charging.hpp"

#include <limits>
#include <utility>

#include "bie/physics/coupled_equation.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// a V − b of all membranes.
struct Charging {
  std::vector<Storage> storages;
  std::vector<Vector> given;  ///< b: values where a varies, coefficients elsewhere

  void add_uniform(double a, Vector b) {
    storages.push_back({a});
    given.push_back(std::move(b));
  }
  /// Where something differs from place to place.
  void add_varying(ChargingStep step) {
    const double largest = step.a.maxCoeff();
    storages.push_back({largest, std::move(step.a)});
    given.push_back(std::move(step.b));
  }
};

SolveReport solve_charging(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                           const Charging& charging, double tolerance, std::vector<Vector>& potentials) {
  const CoupledEquation equation(membranes, interaction, charging.storages);
  std::vector<Vector> of_own(membranes.size()), charges(membranes.size());
  for (const std::size_t b : interaction.shares().own(membranes.size())) {
    const Vector& given = charging.given[b];
    const double factor = equation.charge_of_current(b);
    const bool varies = charging.storages[b].varying.size() > 0;
    charges[b] = varies ? equation.weighted_values(b, factor, given) : equation.weighted(b, factor, given);
    of_own[b] = varies ? equation.own(b).right_side_of_values(given) : equation.own(b).right_side(given);
  }
  return equation.solve(equation.right_sides(of_own, charges), tolerance, potentials);
}

}  // namespace

SolveReport charge_membranes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                             const std::vector<ChargingParameters>& charging, double dt, double tolerance,
                             std::vector<Vector>& potentials) {
  Charging all;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    const auto& [electric, membrane] = membranes[i];
    if (charges_by_place(membrane)) {
      all.add_varying(charging_step(electric, charging[i], membrane, dt, potentials[i]));
    } else {
      const double capacitive = charging[i].capacitance / dt;
      all.add_uniform(capacitive + charging[i].conductance, capacitive * potentials[i]);
    }
  }
  return solve_charging(membranes, interaction, all, tolerance, potentials);
}

SolveReport solve_varying_charging(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                   std::vector<ChargingStep> steps, double tolerance, std::vector<Vector>& potentials) {
  Charging all;
  for (ChargingStep& step : steps) all.add_varying(std::move(step));
  return solve_charging(membranes, interaction, all, tolerance, potentials);
}

SolveReport steady_potentials(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                              const std::vector<ChargingParameters>& charging, double tolerance,
                              std::vector<Vector>& potentials) {
  Charging all;
  for (std::size_t i = 0; i < membranes.size(); ++i) {
    const auto& [electric, membrane] = membranes[i];
    if (charging[i].conductance == 0.0 && series_conductivity(electric) == 0.0) {
      throw InputError(
          "a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
    }
    const Vector none = Vector::Zero(n_coefficients(membrane.fine.order()));
    if (potentials[i].size() == 0) potentials[i] = none;
    if (charges_by_place(membrane)) {
      ChargingStep step =
          charging_step(electric, charging[i], membrane, std::numeric_limits<double>::infinity(), potentials[i]);
      if (step.a.maxCoeff() > 0.0) {
        all.add_varying(std::move(step));
        continue;
      }
      if (membrane.material.pump_current.size() > 0) {
        throw InputError("a steady V_m is not determined: a pump works on a membrane that does not conduct");
      }
    }
    all.add_uniform(charging[i].conductance, none);
  }
  return solve_charging(membranes, interaction, all, tolerance, potentials);
}

}  // namespace vehd
