#include "bie/stepping/evaluation/relaxing_charge.hpp"

#include <utility>

#include "bie/physics/charge_relaxation.hpp"

namespace vehd {

Matrix force_of_charges(const VesicleTask& task, const ElectricParameters& electric, int& iterations) {
  const Membrane& membrane = task.membrane;
  const FaceCharges charges{task.state.transmembrane_potential, task.state.free_charge};
  RelaxingField field = field_of_charges(electric, task.vesicle.charging, membrane, charges,
                                         task.settings.electric_tolerance, charges.inner);
  require_converged(field.report, "V_m of free charges");
  iterations += field.report.iterations;
  FaceCharges rates = charge_rates(electric, task.vesicle.charging, membrane, field);
  task.solution.potential_rate = std::move(rates.inner);
  task.solution.free_charge_rate = std::move(rates.sum);
  task.fields.charge = membrane.fine.analyze(field.traces.charge);
  task.fields.potential = std::move(field.potential);
  return electric_force(electric.permittivity, membrane, field.traces, electric.permittivity_ratio);
}

void without_charges(const VesicleTask& task) {
  const Vector none = Vector::Zero(task.state.position.rows());
  task.fields.potential = none;
  task.solution.free_charge_rate = none;
}

}  // namespace vehd
