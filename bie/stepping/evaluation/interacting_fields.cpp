#include "bie/stepping/evaluation/interacting_fields.hpp"

#include <algorithm>
#include <utility>

#include "bie/physics/coupled_electric.hpp"
#include "bie/stepping/evaluation/averaged_forces.hpp"
#include "bie/stepping/evaluation/relaxing_charge.hpp"
#include "bie/stepping/solve/coupled_tension.hpp"
#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// f_E of each with q and dV_m/dt as by-products. @returns values on the upsampled grids
std::vector<Matrix> forces_of_densities(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                        SolvedFields& solved) {
  std::vector<ElectricMembrane> membranes;
  std::vector<Vector> potentials;
  for (const VesicleTask& task : tasks) {
    membranes.push_back({electric_parameters(task.model, task.vesicle).at(time, limit), task.membrane});
    potentials.push_back(task.state.transmembrane_potential);
  }
  const Interaction& interaction = *solved.interaction;
  const CoupledDensities densities =
      solve_second_kind(membranes, interaction, weighted_fluxes(membranes, interaction, potentials),
                        tasks.front().settings.electric_tolerance);
  require_converged(densities.report, "charge densities, Eq. (12)");
  solved.iterations_electric += densities.report.iterations;
  const std::vector<Vector> of_others = potentials_of_others(membranes, interaction, potentials, densities.membranes);
  std::vector<Matrix> forces(tasks.size());
  for_each_member(interaction.shares().own(tasks.size()), [&](std::size_t a) {
    const VesicleTask& task = tasks[a];
    const ElectricParameters& electric = membranes[a].electric;
    const ElectricTraces traces =
        electric_traces(electric, task.membrane, potentials[a], densities.membranes[a], of_others[a]);
    task.fields.charge = task.membrane.fine.analyze(traces.charge);
    task.solution.potential_rate = charging_rate(task, electric, traces);
    forces[a] = electric_force(electric.permittivity, task.membrane, traces, electric.permittivity_ratio);
    task.fields.force_electric = task.membrane.fine.analyze(forces[a]);
  });
  return forces;
}

/// Adds the forces of the potential between the vesicles, which become fields of theirs.
void add_contact(const ContactParameters& contact, const std::vector<VesicleTask>& tasks,
                 std::vector<Forcing>& forcing) {
  std::vector<ContactMembrane> membranes;
  for (const VesicleTask& task : tasks) membranes.push_back({task.state.position, task.membrane});
  const std::vector<Matrix> forces = contact_forces(contact, membranes);
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    tasks[a].fields.force_contact = tasks[a].membrane.fine.analyze(forces[a]);
    forcing[a].force += forces[a];
  }
}

/// What the symmetry leaves of a velocity; the interaction knows nothing of it.
Matrix symmetric(const Membrane& membrane, const Matrix& velocity) {
  return membrane.subspace.symmetry().any() ? membrane.subspace.symmetric_vector(velocity) : velocity;
}

/// Velocities under the forcing, with the tensions that keep the membranes inextensible, Eq. (27b).
void solve_velocities(const std::vector<VesicleTask>& tasks, const std::vector<Forcing>& forcing,
                      SolvedFields& solved) {
  std::vector<FlowMembrane> membranes;
  const std::vector<std::size_t> own = solved.interaction->shares().own(tasks.size());
  std::vector<Matrix> weighted(tasks.size()), background;
  std::vector<bool> is_sphere;
  std::vector<Vector> start;
  std::vector<RecycledSubspace> known;
  for (const std::size_t a : own) weighted[a] = tasks[a].membrane.weighted(forcing[a].force);
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    const VesicleTask& task = tasks[a];
    membranes.push_back({flow_parameters(task.model, task.vesicle), task.membrane});
    background.push_back(forcing[a].velocity);
    is_sphere.push_back(task.solution.is_sphere);
    start.push_back(task.state.tension);
    const auto& recycled = task.state.recycled.tension;
    known.push_back(recycled ? recycled->in(task.space.subspace().scalars(), 1) : RecycledSubspace{});
  }
  CoupledFlow flow(membranes, *solved.interaction);
  const CoupledTension tensions = solve_tensions(membranes, is_sphere, flow, std::move(weighted), background, start,
                                                 known, tasks.front().settings.flow_tolerance);
  require_converged(tensions.report, "tensions, Eq. (27b)");
  solved.iterations_flow += tensions.report.iterations;
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    if (!tasks[a].vesicle.inextensible) continue;
    tasks[a].solution.recycled.tension = recycled_scalars(tasks[a].space.subspace().scalars(), tensions.learned[a]);
  }
  for_each_member(own, [&](std::size_t a) {
    const VesicleTask& task = tasks[a];
    task.fields.velocity = symmetric(task.membrane, tensions.velocities[a]);
    if (!task.vesicle.inextensible) return;
    task.fields.tension = tensions.tension[a];
    task.fields.force_tension = task.membrane.fine.analyze(tensions.force[a]);
  });
}

}  // namespace

PairSettings pair_settings(const NumericalSettings& settings) {
  PairSettings result;
  result.tolerance = std::max(result.tolerance, thresholds::pair_share * settings.quadrature_tolerance);
  return result;
}

std::shared_ptr<const Interaction> interaction_of(const std::vector<VesicleTask>& tasks, bool electric_active,
                                                  const Discretisation& discretisation, Instruments& instruments) {
  std::vector<InteractingMembrane> membranes;
  for (const VesicleTask& task : tasks) {
    PairSelection selection;
    if (task.model.electric && electric_active) {
      selection = electric_pair_selection(electric_parameters(task.model, task.vesicle));
    }
    if (task.model.mobile) {
      const PairSelection flow = flow_pair_selection(flow_parameters(task.model, task.vesicle));
      selection.stokes_single = flow.stokes_single;
      selection.stokes_double = flow.stokes_double;
    }
    membranes.push_back({task.state.position, task.space.targets(), selection});
  }
  return std::make_shared<const Interaction>(membranes, pair_settings(tasks.front().settings), instruments,
                                             discretisation.shares(), discretisation.symmetry().exchange,
                                             discretisation.pair_transforms());
}

void solve_interacting(const std::vector<VesicleTask>& tasks, double time, Limit limit, Instruments& instruments,
                       SolvedFields& solved) {
  const std::vector<std::size_t> own = solved.interaction->shares().own(tasks.size());
  std::vector<Forcing> forcing;
  for (const VesicleTask& task : tasks) {
    forcing.push_back({Matrix::Zero(task.membrane.surface.n_points(), 3), Matrix::Zero(task.state.position.rows(), 3)});
  }
  if (tasks.front().model.electric && solved.electric_inactive) {
    for (const VesicleTask& task : tasks) without_charges(task);
  } else if (tasks.front().model.electric) {
    const auto timer = instruments.time("electric");
    const Model& model = tasks.front().model;
    const std::vector<Matrix> forces = is_averaged(model)      ? averaged_forces(tasks, solved)
                                       : relaxes_charge(model) ? forces_of_charges(tasks, time, limit, solved)
                                                               : forces_of_densities(tasks, time, limit, solved);
    for (const std::size_t a : own) forcing[a].force -= forces[a];
  }
  for (const std::size_t a : own) add_poration(tasks[a]);
  if (!tasks.front().model.mobile) return;
  if (tasks.front().model.contact) {
    const auto timer = instruments.time("contact");
    add_contact(*tasks.front().model.contact, tasks, forcing);
  }
  const auto timer = instruments.time("tension solve");
  for_each_member(own, [&](std::size_t a) {
    add_forces(tasks[a], {tasks[a].membrane, tasks[a].state.position, time, limit}, forcing[a]);
  });
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    if (!solved.interaction->exchange().is_image(a)) continue;
    // What of an image follows from no field of its original.
    Forcing of_image{Matrix::Zero(tasks[a].membrane.surface.n_points(), 3),
                     Matrix::Zero(tasks[a].state.position.rows(), 3)};
    add_effects(tasks[a], {tasks[a].membrane, tasks[a].state.position, time, limit}, of_image);
  }
  solve_velocities(tasks, forcing, solved);
}

}  // namespace vehd
