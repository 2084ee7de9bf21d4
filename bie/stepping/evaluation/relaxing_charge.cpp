#include "bie/stepping/evaluation/relaxing_charge.hpp"

#include <utility>

#include "bie/physics/charge_relaxation.hpp"

namespace vehd {

namespace {

void take_charges(const VesicleTask& task) {
  const double capacitance = task.vesicle.charging.capacitance;
  const Vector& inner = task.state.transmembrane_potential;
  task.fields.free_charge_in = capacitance * inner;
  task.fields.free_charge_out = capacitance * (task.state.free_charge - inner);
}

std::vector<RelaxingField> solved_fields(const std::vector<VesicleTask>& tasks,
                                         const std::vector<ChargingMembrane>& membranes,
                                         const Interaction* interaction) {
  const double tolerance = tasks.front().settings.electric_tolerance;
  std::vector<FaceCharges> charges;
  std::vector<Vector> start;
  for (const VesicleTask& task : tasks) {
    charges.push_back({task.state.transmembrane_potential, task.state.free_charge});
    start.push_back(task.state.transmembrane_potential);
  }
  return fields_of_charges(membranes, interaction, charges, tolerance, std::move(start));
}

}  // namespace

std::vector<Matrix> forces_of_charges(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                      SolvedFields& solved) {
  std::vector<ChargingMembrane> membranes;
  for (const VesicleTask& task : tasks) {
    membranes.push_back(
        {{electric_parameters(task.model, task.vesicle).at(time, limit), task.membrane}, task.vesicle.charging});
  }
  std::vector<RelaxingField> fields = solved_fields(tasks, membranes, solved.interaction.get());
  require_converged(fields.front().report, "V_m of free charges");
  solved.iterations_electric += fields.front().report.iterations;
  const Shares shares = solved.interaction ? solved.interaction->shares() : Shares();
  std::vector<Matrix> forces(tasks.size());
  for (const std::size_t a : shares.own(tasks.size())) {
    const VesicleTask& task = tasks[a];
    const ElectricParameters& electric = membranes[a].in_field.electric;
    FaceCharges rates = charge_rates(membranes[a], fields[a], current_through(task, electric, fields[a].potential));
    task.solution.potential_rate = std::move(rates.inner);
    task.solution.free_charge_rate = std::move(rates.sum);
    take_charges(task);
    task.fields.charge = task.membrane.fine.analyze(fields[a].traces.charge);
    task.fields.potential = std::move(fields[a].potential);
    forces[a] = electric_force(electric.permittivity, task.membrane, fields[a].traces, electric.permittivity_ratio);
    task.fields.force_electric = task.membrane.fine.analyze(forces[a]);
  }
  return forces;
}

void without_charges(const VesicleTask& task) {
  const Index n = task.state.position.rows();
  task.fields.charge = Vector::Zero(n);
  task.fields.force_electric = Matrix::Zero(n, 3);
  if (is_averaged(task.model)) {
    // V_m is no unknown there and has no rate.
    task.fields.potential_amplitude = task.fields.charge_amplitude = Matrix::Zero(n, 2);
    return;
  }
  task.solution.potential_rate = Vector::Zero(n);
  if (!relaxes_charge(task.model)) return;
  take_charges(task);
  task.fields.potential = Vector::Zero(n);
  task.solution.free_charge_rate = Vector::Zero(n);
}

}  // namespace vehd
