#include "bie/stepping/time/charge_step.hpp"

#include <utility>

#include "bie/physics/coupled_charging.hpp"
#include "bie/physics/coupled_relaxation.hpp"
#include "bie/physics/membrane_charging.hpp"

namespace vehd {

namespace {

SolveReport charge_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                              double tolerance, std::vector<Charge>& charges) {
  if (interaction == nullptr) {
    const auto& [in_field, charging] = membranes.front();
    return charge_membrane(in_field.electric, charging, in_field.membrane, dt, tolerance, charges.front().potential);
  }
  std::vector<Vector> potentials;
  std::vector<ElectricMembrane> in_field;
  std::vector<ChargingParameters> charging;
  for (std::size_t a = 0; a < charges.size(); ++a) {
    in_field.push_back(membranes[a].in_field);
    charging.push_back(membranes[a].charging);
    potentials.push_back(std::move(charges[a].potential));
  }
  const SolveReport report = charge_membranes(in_field, *interaction, charging, dt, tolerance, potentials);
  for (std::size_t a = 0; a < charges.size(); ++a) charges[a].potential = std::move(potentials[a]);
  return report;
}

SolveReport relax(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                  double tolerance, std::vector<Charge>& charges) {
  std::vector<FaceCharges> faces;
  for (Charge& charge : charges) faces.push_back({std::move(charge.potential), std::move(charge.free)});
  const auto& [in_field, charging] = membranes.front();
  const SolveReport report = interaction == nullptr ? relax_charges(in_field.electric, charging, in_field.membrane, dt,
                                                                    tolerance, faces.front())
                                                    : relax_charges(membranes, *interaction, dt, tolerance, faces);
  for (std::size_t a = 0; a < charges.size(); ++a) charges[a] = {std::move(faces[a].inner), std::move(faces[a].sum)};
  return report;
}

}  // namespace

SolveReport charge_step(const Model& model, const SolvedFields& at_start,
                        const std::vector<ElectricParameters>& electric, double dt, double tolerance,
                        std::vector<Charge>& charges) {
  std::vector<ChargingMembrane> membranes;
  for (std::size_t a = 0; a < charges.size(); ++a) {
    membranes.push_back({{electric[a], *at_start.vesicles[a].membrane}, model.vesicles[a].charging});
  }
  const Interaction* interaction = at_start.interaction.get();
  return relaxes_charge(model) ? relax(membranes, interaction, dt, tolerance, charges)
                               : charge_potentials(membranes, interaction, dt, tolerance, charges);
}

}  // namespace vehd
