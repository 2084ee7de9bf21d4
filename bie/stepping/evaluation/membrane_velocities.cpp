#include <utility>

#include "bie/physics/effects/bending.hpp"
#include "bie/stepping/evaluation/vesicle_task.hpp"
#include "bie/stepping/solve/rigid_sphere.hpp"
#include "bie/stepping/solve/tension_solve.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

Forcing no_forcing(const VesicleTask& task) {
  return {Matrix::Zero(task.membrane.surface.n_points(), 3), Matrix::Zero(task.state.position.rows(), 3)};
}

/// Adds the explicit effects and stores their force.
void add_effects(const VesicleTask& task, double time, Limit limit, Forcing& forcing) {
  const auto effects = explicit_effects(task.model, task.vesicle);
  if (effects.empty()) return;
  const EffectInput input{task.membrane, task.state.position, time, limit};
  const Matrix without = forcing.force;
  for (const auto& effect : effects) effect->add(input, forcing);
  task.solution.force_of_effects = forcing.force - without;
}

void add_bending(const VesicleTask& task, Forcing& forcing) {
  if (!task.vesicle.bending) return;
  const Matrix bending = has_varying_bending(task.membrane) ? elastic_force(task.membrane)
                                                            : bending_force(*task.vesicle.bending, task.membrane);
  task.fields.force_bending = task.membrane.fine.analyze(bending);
  forcing.force += bending;
}

/// Adds the forces of the potential between the vesicles.
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

/// Symmetric part of a velocity.
Matrix symmetric(const Membrane& membrane, const Matrix& velocity) {
  return membrane.subspace.symmetry().any() ? membrane.subspace.symmetric_vector(velocity) : velocity;
}

/// Velocities under the forcing and the tensions, Eq. (27b).
void solve_flow(const std::vector<VesicleTask>& tasks, const std::vector<Forcing>& forcing, SolvedFields& solved) {
  std::vector<FlowMembrane> membranes;
  const std::vector<std::size_t> own = solved.interaction->partition().local_indices(tasks.size());
  std::vector<Matrix> weighted(tasks.size()), background;
  std::vector<bool> is_sphere;
  std::vector<Vector> start;
  std::vector<RecycledSubspace> recycled;
  for (const std::size_t a : own) weighted[a] = tasks[a].membrane.weighted(forcing[a].force);
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    const VesicleTask& task = tasks[a];
    membranes.push_back({flow_parameters(task.model, task.vesicle), task.membrane});
    background.push_back(forcing[a].velocity);
    is_sphere.push_back(task.solution.is_sphere);
    start.push_back(task.state.tension);
    const auto& of_tension = task.state.recycled.tension;
    recycled.push_back(of_tension ? of_tension->in(task.space.subspace().scalars(), 1) : RecycledSubspace{});
  }
  MembraneFlow flow(membranes, *solved.interaction);
  const SolvedTensions tensions = solve_tensions(membranes, is_sphere, flow, std::move(weighted), background, start,
                                                 recycled, tasks.front().settings.flow_tolerance);
  require_converged(tensions.report, "tensions, Eq. (27b)");
  solved.iterations_flow += tensions.report.iterations;
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    if (!tasks[a].vesicle.inextensible) continue;
    tasks[a].solution.recycled.tension = recycled_scalars(tasks[a].space.subspace().scalars(), tensions.recycled[a]);
  }
  for_each_member(own, [&](std::size_t a) {
    const VesicleTask& task = tasks[a];
    task.fields.velocity = symmetric(task.membrane, tensions.velocities[a]);
    task.solution.rate.position =
        task.solution.is_sphere ? rigid_sphere_velocity(task.membrane, task.fields.velocity) : task.fields.velocity;
    if (!task.vesicle.inextensible) return;
    task.fields.tension = tensions.tension[a];
    task.fields.force_tension = task.membrane.fine.analyze(tensions.force[a]);
  });
}

}  // namespace

void solve_velocities(const std::vector<VesicleTask>& tasks, const std::vector<Matrix>& forces_electric, double time,
                      Limit limit, Instruments& instruments, SolvedFields& solved) {
  const Model& model = tasks.front().model;
  const std::vector<std::size_t> own = solved.interaction->partition().local_indices(tasks.size());
  std::vector<Forcing> forcing;
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    forcing.push_back(no_forcing(tasks[a]));
    if (forces_electric[a].size() > 0) forcing[a].force -= forces_electric[a];
  }
  if (model.contact) {
    const auto timer = instruments.time("contact");
    add_contact(*model.contact, tasks, forcing);
  }
  const auto timer = instruments.time("tension solve");
  for_each_member(own, [&](std::size_t a) {
    add_effects(tasks[a], time, limit, forcing[a]);
    add_bending(tasks[a], forcing[a]);
  });
  for (std::size_t a = 0; a < tasks.size(); ++a) {
    if (!solved.interaction->exchange().is_image(a)) continue;
    // force_of_effects holds values on a grid and is not copied from the original.
    Forcing of_image = no_forcing(tasks[a]);
    add_effects(tasks[a], time, limit, of_image);
  }
  solve_flow(tasks, forcing, solved);
}

}  // namespace vehd
