#include "bie/physics/membrane_charging.hpp"

#include <limits>

#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

CurrentLaw law_of_charging(const ChargingMembrane& of, const MembraneCurrent& current, double dt,
                           const Vector& potential) {
  const auto& [electric, membrane] = of.in_field;
  const Vector storage = capacitance_of(of.charging, membrane) / dt;
  const Vector b = storage.cwiseProduct(Vector(membrane.fine.synthesize(potential))) - current.constant;
  return {storage + current.conductance, electric.conductivity_in, electric.conductivity_out, b, -b};
}

SolveReport charge_membranes(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                             double tolerance, std::vector<Vector>& potentials) {
  std::vector<ElectricMembrane> in_field;
  std::vector<CurrentLaw> laws;
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    in_field.push_back(membranes[a].in_field);
    laws.push_back(law_of_charging(membranes[a], membrane_current(membranes[a]), dt, potentials[a]));
  }
  return solve_laws(in_field, interaction, laws, tolerance, potentials);
}

SolveReport steady_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction,
                              double tolerance, std::vector<Vector>& potentials) {
  for (std::size_t a = 0; a < membranes.size(); ++a) {
    const auto& [electric, membrane] = membranes[a].in_field;
    const bool conducts = conductance_of(membranes[a].charging, membrane).maxCoeff() > 0.0;
    if (!conducts && series_conductivity(electric) == 0.0) {
      throw InputError(
          "a steady V_m is not determined: the membrane conductance and a bulk conductivity are both zero");
    }
    if (!conducts && membrane.material.pump_current.size() > 0) {
      throw InputError("a steady V_m is not determined: a pump works on a membrane that does not conduct");
    }
    if (potentials[a].size() == 0) potentials[a] = Vector::Zero(n_coefficients(membrane.fine.order()));
  }
  return charge_membranes(membranes, interaction, std::numeric_limits<double>::infinity(), tolerance, potentials);
}

}  // namespace vehd
