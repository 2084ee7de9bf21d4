#include <utility>

#include "bie/physics/averaged_field.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_charging.hpp"
#include "bie/stepping/evaluation/vesicle_task.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

ChargingMembrane charging_membrane(const VesicleTask& task, double time, Limit limit) {
  return {{electric_parameters(task.model, task.vesicle).at(time, limit), task.membrane},
          task.vesicle.charging,
          task.vesicle.reaction.get()};
}

/// Stores q and f_E. @returns f_E, values on the upsampled grid
Matrix take_traces(const VesicleTask& task, const ElectricParameters& electric, const ElectricTraces& traces) {
  task.fields.charge = task.membrane.fine.analyze(traces.charge);
  Matrix force = electric_force(electric.permittivity, task.membrane, traces, electric.permittivity_ratio);
  task.fields.force_electric = task.membrane.fine.analyze(force);
  return force;
}

/// Stores the free charges of both faces.
void take_charges(const VesicleTask& task) {
  const double capacitance = task.vesicle.charging.capacitance;
  const Vector& inner = task.state.transmembrane_potential;
  task.fields.free_charge_in = capacitance * inner;
  task.fields.free_charge_out = capacitance * (task.state.free_charge - inner);
}

/// dV_m/dt = −(σ_i ∂φ_i/∂n + I)/C_m with the current I through the membrane, Eq. (4e), coefficients.
Vector charging_rate(const VesicleTask& task, const ChargingMembrane& of, const ElectricTraces& traces) {
  const Membrane& membrane = task.membrane;
  Vector current = without_net_current(membrane, of.in_field.electric.conductivity_in * traces.flux_in);
  current += current_through(membrane, membrane_current(of, task.state.poration), task.state.transmembrane_potential);
  return -membrane.fine.analyze(Vector(current.cwiseQuotient(capacitance_of(of.charging, membrane))));
}

std::vector<Matrix> forces_of_potentials(const std::vector<VesicleTask>& tasks,
                                         const std::vector<ChargingMembrane>& membranes, SolvedFields& solved) {
  const Interaction& interaction = *solved.interaction;
  std::vector<ElectricMembrane> in_field;
  std::vector<Vector> potentials;
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    in_field.push_back(membranes[a].in_field);
    potentials.push_back(tasks[a].state.transmembrane_potential);
  }
  const std::vector<SecondKindSolution> densities =
      solve_second_kind(in_field, interaction, weighted_fluxes(in_field, interaction, potentials),
                        tasks.front().settings.electric_tolerance);
  require_converged(densities.front().report, "charge densities, Eq. (12)");
  solved.iterations_electric += densities.front().report.iterations;
  const std::vector<Vector> of_others = potentials_of_others(in_field, interaction, potentials, densities);
  std::vector<Matrix> forces(tasks.size());
  for_each_member(interaction.partition().local_indices(tasks.size()), [&](std::size_t a) {
    const ElectricParameters& electric = in_field[a].electric;
    const ElectricTraces traces =
        electric_traces(electric, tasks[a].membrane, potentials[a], densities[a], of_others[a]);
    tasks[a].solution.rate.transmembrane_potential = charging_rate(tasks[a], membranes[a], traces);
    forces[a] = take_traces(tasks[a], electric, traces);
  });
  return forces;
}

std::vector<Matrix> forces_of_charges(const std::vector<VesicleTask>& tasks,
                                      const std::vector<ChargingMembrane>& membranes, SolvedFields& solved) {
  std::vector<Unknowns> charges;
  std::vector<Vector> guess;
  for (const VesicleTask& task : tasks) {
    charges.push_back({{}, task.state.transmembrane_potential, task.state.free_charge});
    guess.push_back(task.state.transmembrane_potential);
  }
  std::vector<RelaxingField> fields = fields_of_charges(membranes, *solved.interaction, charges,
                                                        tasks.front().settings.electric_tolerance, std::move(guess));
  require_converged(fields.front().report, "V_m of free charges");
  solved.iterations_electric += fields.front().report.iterations;
  std::vector<Matrix> forces(tasks.size());
  for (const std::size_t a : solved.interaction->partition().local_indices(tasks.size())) {
    const VesicleTask& task = tasks[a];
    const MembraneCurrent current = membrane_current(membranes[a], task.state.poration);
    task.solution.rate =
        charge_rates(membranes[a], fields[a], current_through(task.membrane, current, fields[a].potential));
    take_charges(task);
    forces[a] = take_traces(task, membranes[a].in_field.electric, fields[a].traces);
    task.fields.potential = std::move(fields[a].potential);
  }
  return forces;
}

std::vector<Matrix> forces_of_amplitudes(const std::vector<VesicleTask>& tasks,
                                         const std::vector<ChargingMembrane>& membranes, SolvedFields& solved) {
  AveragedFields averaged =
      solve_averaged_fields(membranes, *solved.interaction, tasks.front().settings.electric_tolerance);
  require_converged(averaged.report, "amplitudes of V_m in an averaged field");
  solved.iterations_electric += averaged.report.iterations;
  std::vector<Matrix> forces(tasks.size());
  for (const std::size_t a : solved.interaction->partition().local_indices(tasks.size())) {
    AveragedField& field = averaged.membranes[a];
    tasks[a].fields.potential_amplitude = std::move(field.potential);
    tasks[a].fields.charge_amplitude = std::move(field.charge);
    tasks[a].fields.force_electric = tasks[a].membrane.fine.analyze(field.force);
    forces[a] = std::move(field.force);
  }
  return forces;
}

void take_zeros(const VesicleTask& task) {
  const Index n = task.state.position.rows();
  task.fields.charge = Vector::Zero(n);
  task.fields.force_electric = Matrix::Zero(n, 3);
  if (is_averaged(task.model)) {
    // V_m is not an unknown here and has no rate.
    task.fields.potential_amplitude = task.fields.charge_amplitude = Matrix::Zero(n, 2);
    return;
  }
  task.solution.rate.transmembrane_potential = Vector::Zero(n);
  if (!relaxes_charge(task.model)) return;
  take_charges(task);
  task.fields.potential = Vector::Zero(n);
  task.solution.rate.free_charge = Vector::Zero(n);
}

}  // namespace

std::vector<Matrix> solve_electric(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                   SolvedFields& solved) {
  if (solved.electric_inactive) {
    for (const VesicleTask& task : tasks) take_zeros(task);
    return std::vector<Matrix>(tasks.size());
  }
  std::vector<ChargingMembrane> membranes;
  for (const VesicleTask& task : tasks) membranes.push_back(charging_membrane(task, time, limit));
  const Model& model = tasks.front().model;
  if (is_averaged(model)) return forces_of_amplitudes(tasks, membranes, solved);
  if (relaxes_charge(model)) return forces_of_charges(tasks, membranes, solved);
  return forces_of_potentials(tasks, membranes, solved);
}

void solve_poration(const VesicleTask& task, double time, Limit limit) {
  if (!task.vesicle.reaction) return;
  const SphereTransform& fine = task.membrane.fine;
  const Vector& state = task.state.poration;
  const Vector conductance = membrane_current(charging_membrane(task, time, limit), state).conductance;
  task.fields.conductance = fine.analyze(conductance);
  task.solution.rate.poration =
      reaction_rate(*task.vesicle.reaction, fine, state, transmembrane_potential(task.state, task.fields));
}

}  // namespace vehd
