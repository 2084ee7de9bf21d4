#include "bie/stepping/evaluation/vesicle_task.hpp"

#include "bie/physics/bending.hpp"
#include "bie/physics/current_law.hpp"
#include "bie/physics/elasticity_by_place.hpp"
#include "bie/physics/porous_charging.hpp"
#include "bie/stepping/state/composition.hpp"

namespace vehd {

Vector charging_rate(const VesicleTask& task, const ElectricParameters& electric, const ElectricTraces& traces) {
  const Membrane& membrane = task.membrane;
  const ChargingParameters& charging = task.vesicle.charging;
  const Vector& area = membrane.surface.quadrature;
  Vector current = electric.conductivity_in * traces.flux_in;
  current.array() -= current.dot(area) / area.sum();
  current += current_through(task, electric, task.state.transmembrane_potential);
  return -membrane.fine.analyze(Vector(current.cwiseQuotient(capacitance_of(charging, membrane))));
}

Vector current_through(const VesicleTask& task, const ElectricParameters& electric, const Vector& potential) {
  const Membrane& membrane = task.membrane;
  MembraneCurrent current = membrane_current({{electric, membrane}, task.vesicle.charging});
  if (task.vesicle.reaction) {
    current.conductance =
        porous_conductance(*task.vesicle.reaction, task.vesicle.charging, membrane, task.state.poration);
  }
  return current_through(membrane, current, potential);
}

void add_poration(const VesicleTask& task) {
  if (!task.vesicle.reaction) return;
  const PorationReaction& reaction = *task.vesicle.reaction;
  task.solution.poration_rate =
      reaction_rate(reaction, task.membrane, {transmembrane_potential(task.state, task.fields), task.state.poration});
  task.fields.conductance = task.membrane.fine.analyze(
      porous_conductance(reaction, task.vesicle.charging, task.membrane, task.state.poration));
}

void add_effects(const VesicleTask& task, const EffectInput& input, Forcing& forcing) {
  const auto effects = explicit_effects(task.model, task.vesicle);
  if (effects.empty()) return;
  const Matrix without = forcing.force;
  for (const auto& effect : effects) effect->add(input, forcing);
  task.solution.force_of_effects = forcing.force - without;
}

void add_forces(const VesicleTask& task, const EffectInput& input, Forcing& forcing) {
  add_effects(task, input, forcing);
  if (!task.vesicle.bending) return;
  const Matrix bending = bends_by_place(task.membrane) ? elastic_force(task.membrane)
                                                       : bending_force(*task.vesicle.bending, task.membrane);
  task.fields.force_bending = task.membrane.fine.analyze(bending);
  forcing.force += bending;
}

}  // namespace vehd
