#include "bie/stepping/evaluation/vesicle_task.hpp"

#include "bie/physics/bending.hpp"
#include "bie/stepping/state/composition.hpp"

namespace vehd {

Vector charging_rate(const VesicleTask& task, const ElectricParameters& electric, const ElectricTraces& traces) {
  const Membrane& membrane = task.membrane;
  const ChargingParameters& charging = task.vesicle.charging;
  const Vector& area = membrane.surface.quadrature;
  Vector current = electric.conductivity_in * traces.flux_in;
  current.array() -= current.dot(area) / area.sum();
  return -(membrane.fine.analyze(current) + charging.conductance * task.state.transmembrane_potential) /
         charging.capacitance;
}

void add_forces(const VesicleTask& task, const EffectInput& input, Forcing& forcing) {
  for (const auto& effect : explicit_effects(task.model, task.vesicle)) effect->add(input, forcing);
  if (!task.vesicle.bending) return;
  const Matrix bending = bending_force(*task.vesicle.bending, task.membrane);
  task.fields.force_bending = task.membrane.fine.analyze(bending);
  forcing.force += bending;
}

}  // namespace vehd
