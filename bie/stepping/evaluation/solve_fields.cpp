#include <cstddef>

#include "bie/physics/electric.hpp"
#include "bie/physics/tension.hpp"
#include "bie/stepping/evaluation/averaged_forces.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/evaluation/gather_solution.hpp"
#include "bie/stepping/evaluation/interacting_fields.hpp"
#include "bie/stepping/evaluation/relaxing_charge.hpp"
#include "bie/stepping/evaluation/vesicle_task.hpp"
#include "bie/stepping/solve/flow_system.hpp"
#include "bie/stepping/space/membrane_at.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// f_E with q and dV_m/dt as by-products, Eqs. (12), (15), (32). @returns values on the upsampled grid
Matrix solve_electric(const VesicleTask& task, double time, Limit limit, int& iterations) {
  const Membrane& membrane = task.membrane;
  const ElectricParameters electric = electric_parameters(task.model, task.vesicle).at(time, limit);
  const Vector& potential = task.state.transmembrane_potential;
  const Vector rhs = weighted_field_flux(membrane, electric.field) + weighted_hypersingular(membrane, potential);
  const SecondKindSolution density =
      solve_second_kind(membrane, conductivity_contrast(electric), rhs, task.settings.electric_tolerance, {});
  require_converged(density.report, "charge density, Eq. (12)");
  iterations += density.report.iterations;
  const ElectricTraces traces = electric_traces(electric, membrane, potential, density);
  task.fields.charge = membrane.fine.analyze(traces.charge);
  task.solution.potential_rate = charging_rate(task, electric, traces);
  Matrix force = electric_force(electric.permittivity, membrane, traces, electric.permittivity_ratio);
  task.fields.force_electric = membrane.fine.analyze(force);
  return force;
}

/// Velocity of the membrane under the forcing, with the tension that keeps it inextensible, Eq. (27b).
void solve_velocity(const VesicleTask& task, const Forcing& forcing, int& iterations) {
  const Membrane& membrane = task.membrane;
  Matrix velocity = forcing.velocity;
  if (!membrane.layers.stokes_single.empty()) {
    velocity += membrane.layers.stokes_single.apply(membrane.weighted(forcing.force)) / task.model.viscosity;
  }
  velocity = membrane.velocity(std::move(velocity));
  if (task.vesicle.inextensible) {
    const VelocityField driven = velocity_field(membrane, velocity, false);
    const FlowRightHandSide rhs{{}, -weighted_divergence(membrane, driven.derivatives)};
    const FlowParameters parameters = flow_parameters(task.model, task.vesicle);
    const FlowOptions options{task.solution.is_sphere, {}, task.space.subspace().scalars()};
    const auto& known = task.state.recycled.tension;
    FlowSystem system(parameters, membrane, 0.0, options, known ? known->in(options.entries, 1) : RecycledSubspace{});
    const FlowSystem::Solution solution = system.solve(rhs, {{}, task.state.tension}, task.settings.flow_tolerance);
    require_converged(solution.report, "tension, Eq. (27b)");
    task.solution.recycled.tension =
        recycled_scalars(options.entries, joined(system.learned(), system.kept(), thresholds::most_recycled));
    iterations += solution.report.iterations;
    velocity += solution.velocity;
    task.fields.tension = solution.unknowns.tension;
    task.fields.force_tension = membrane.fine.analyze(tension_force(membrane, solution.unknowns.tension));
  }
  task.fields.velocity = std::move(velocity);
}

void solve(const VesicleTask& task, double time, Limit limit, Instruments& instruments, SolvedFields& solved) {
  const Membrane& membrane = task.membrane;
  const Index n = task.state.position.rows();
  Forcing forcing{Matrix::Zero(membrane.surface.n_points(), 3), Matrix::Zero(n, 3)};
  if (task.model.electric && solved.electric_inactive) {
    without_charges(task);
  } else if (task.model.electric) {
    const auto timer = instruments.time("electric");
    forcing.force -= is_averaged(task.model)      ? averaged_forces({task}, solved).front()
                     : relaxes_charge(task.model) ? forces_of_charges({task}, time, limit, solved).front()
                                                  : solve_electric(task, time, limit, solved.iterations_electric);
  }
  add_poration(task);
  if (!task.model.mobile) return;
  const auto timer = instruments.time("tension solve");
  add_forces(task, {membrane, task.state.position, time, limit}, forcing);
  solve_velocity(task, forcing, solved.iterations_flow);
}

std::shared_ptr<const Membrane> assembled(const Model& model, const VesicleModel& vesicle, const MembraneSpace& space,
                                          const SurfaceFields& fields, bool electric_active, bool own,
                                          Instruments& instruments) {
  const auto timer = instruments.time("operator assembly");
  const LayerSelection layers = own ? needed_layers(model, vesicle, electric_active) : LayerSelection{};
  Membrane membrane = membrane_at(space, fields.position, layers, vesicle.viscosity_ratio, instruments);
  membrane.material = material_at(space, fields.material);
  return std::make_shared<const Membrane>(std::move(membrane));
}

SolvedFields solve_all(const Model& model, const Discretisation& discretisation, const State& state,
                       Instruments& instruments, const SolvedFields* previous, Limit limit, Shapes shapes) {
  const std::size_t n = state.vesicles.size();
  const Shares& shares = discretisation.shares();
  SolvedFields solved;
  solved.electric_inactive = electric_inactive(model, state, limit);
  solved.fields.vesicles.resize(n);
  solved.vesicles.resize(n);
  const bool same_shapes = shapes == Shapes::of_previous || !model.mobile;
  const bool reuse = same_shapes && previous != nullptr && (solved.electric_inactive || !previous->electric_inactive);
  for_each_member(static_cast<Index>(n), instruments, [&](Index i, Instruments& of_one) {
    const auto a = static_cast<std::size_t>(i);
    VesicleSolution& solution = solved.vesicles[a];
    solution.recycled = state.vesicles[a].recycled;
    solution.membrane = reuse ? previous->vesicles[a].membrane
                              : assembled(model, model.vesicles[a], discretisation.vesicle(a), state.vesicles[a],
                                          !solved.electric_inactive, shares.owns(a), of_one);
    // What truncation does to a sphere within a step makes it no other membrane.
    solution.is_sphere =
        previous != nullptr
            ? previous->vesicles[a].is_sphere
            : model.mobile && uniform_tension_is_free(flow_parameters(model, model.vesicles[a]), *solution.membrane);
  });
  std::vector<VesicleTask> tasks;
  for (std::size_t a = 0; a < n; ++a) {
    tasks.push_back({model, model.vesicles[a], discretisation.settings(), discretisation.vesicle(a), state.vesicles[a],
                     *solved.vesicles[a].membrane, solved.fields.vesicles[a], solved.vesicles[a]});
  }
  if (n == 1) {
    solve(tasks.front(), state.time, limit, instruments, solved);
  } else {
    solved.interaction =
        reuse ? previous->interaction : interaction_of(tasks, !solved.electric_inactive, discretisation, instruments);
    solve_interacting(tasks, state.time, limit, instruments, solved);
    gather_from_owners(shares, discretisation.symmetry().exchange, solved);
  }
  return solved;
}

}  // namespace

SolvedFields solve_fields(const Model& model, const Discretisation& discretisation, const State& state,
                          Instruments& instruments, const SolvedFields* previous, Limit limit, Shapes shapes) {
  return discretisation.shares().ranks().together(
      [&] { return solve_all(model, discretisation, state, instruments, previous, limit, shapes); });
}

}  // namespace vehd
