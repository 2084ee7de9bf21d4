#include "bie/stepping/time/charge_step.hpp"

#include <utility>

#include "bie/physics/charge_relaxation.hpp"
#include "bie/physics/membrane_charging.hpp"

namespace vehd {

SolveReport charge_step(const Model& model, const SolvedFields& at_start,
                        const std::vector<ElectricParameters>& electric, double dt, double tolerance,
                        std::vector<Charge>& charges) {
  std::vector<ChargingMembrane> membranes;
  std::vector<FaceCharges> faces;
  std::vector<Vector> potentials;
  for (std::size_t a = 0; a < charges.size(); ++a) {
    membranes.push_back({{electric[a], *at_start.vesicles[a].membrane}, model.vesicles[a].charging});
    potentials.push_back(charges[a].potential);
    faces.push_back({std::move(charges[a].potential), std::move(charges[a].free)});
  }
  const Interaction* interaction = at_start.interaction.get();
  const SolveReport report = relaxes_charge(model)
                                 ? relax_charges(membranes, interaction, dt, tolerance, faces)
                                 : charge_membranes(membranes, interaction, dt, tolerance, potentials);
  for (std::size_t a = 0; a < charges.size(); ++a) {
    if (relaxes_charge(model)) {
      charges[a] = {std::move(faces[a].inner), std::move(faces[a].sum)};
    } else {
      charges[a].potential = std::move(potentials[a]);
    }
  }
  return report;
}

}  // namespace vehd
