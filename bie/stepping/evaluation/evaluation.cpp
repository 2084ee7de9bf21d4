#include "bie/stepping/evaluation/evaluation.hpp"

#include <algorithm>
#include <cstddef>

#include "bie/physics/electric.hpp"
#include "bie/physics/membrane_flow.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/stepping/evaluation/poration_load.hpp"
#include "bie/stepping/evaluation/vesicle_task.hpp"
#include "bie/stepping/solve/flow_equations.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Tolerance of the layers between vesicles over that of the quadrature: they never limit the accuracy of a run.
constexpr double pair_share = 1e-3;

/// Fields and rates of one vesicle.
struct SolvedVesicle {
  VesicleFields fields;
  Unknowns rate;
};

template <MaybeConst<SolvedVesicle> Vesicle, typename Visit>
void visit_members(Vesicle& vesicle, Visit& visit) {
  visit(vesicle.fields, vesicle.rate);
}

/// Sends fields and rates of each vesicle from its owner to all ranks, and finds those of images from their originals.
/// Membranes, operators and values on a grid stay on the owner. Collective.
void gather_from_owners(const Partition& partition, const Exchange& exchange, SolvedFields& solved) {
  if (partition.ranks().is_alone() && !exchange.any()) return;
  std::vector<SolvedVesicle> all(solved.vesicles.size());
  for (std::size_t a = 0; a < all.size(); ++a) {
    all[a] = {std::move(solved.fields.vesicles[a]), std::move(solved.vesicles[a].rate)};
  }
  partition.gather(all, [&exchange](const SolvedVesicle& of_original, std::size_t a) -> SolvedVesicle {
    const ImageOfFields& image = exchange.image(a);
    return {image_of(image, of_original.fields), image_of(image, of_original.rate)};
  });
  for (std::size_t a = 0; a < all.size(); ++a) {
    solved.fields.vesicles[a] = std::move(all[a].fields);
    solved.vesicles[a].rate = std::move(all[a].rate);
  }
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

/// The layers between the membranes, and those of their images in a wall, that the effects need; those of the electric
/// problem only while it is active.
std::shared_ptr<const Interaction> interaction_of(const std::vector<VesicleTask>& tasks, bool electric_active,
                                                  const Discretisation& discretisation, Instruments& instruments) {
  const std::optional<Wall>& wall = tasks.front().model.wall;
  if (tasks.size() == 1 && !wall) return std::make_shared<const Interaction>();
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
    membranes.push_back({task.state.position, task.space.targets(), selection, task.space.subspace().symmetry()});
  }
  return std::make_shared<const Interaction>(membranes, pair_settings(tasks.front().settings), instruments,
                                             discretisation.partition(), discretisation.symmetry().exchange,
                                             discretisation.pair_transforms(), wall);
}

void solve(const std::vector<VesicleTask>& tasks, double time, Limit limit, Instruments& instruments,
           SolvedFields& solved) {
  std::vector<Matrix> forces_electric(tasks.size());
  if (tasks.front().model.electric) {
    const auto timer = instruments.time("electric");
    forces_electric = solve_electric(tasks, time, limit, solved);
  }
  for (const std::size_t a : solved.interaction->partition().local_indices(tasks.size()))
    solve_poration(tasks[a], time, limit);
  if (tasks.front().model.mobile) solve_velocities(tasks, forces_electric, time, limit, instruments, solved);
}

SolvedFields solve_all(const Model& model, const Discretisation& discretisation, const State& state,
                       Instruments& instruments, const SolvedFields* previous, Limit limit, Shapes shapes) {
  const std::size_t n = state.vesicles.size();
  const Partition& partition = discretisation.partition();
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
                                          !solved.electric_inactive, partition.is_local(a), of_one);
    // A sphere stays a sphere although truncation perturbs it within a step.
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
  solved.interaction =
      reuse ? previous->interaction : interaction_of(tasks, !solved.electric_inactive, discretisation, instruments);
  solve(tasks, state.time, limit, instruments, solved);
  gather_from_owners(solved.interaction->partition(), discretisation.symmetry().exchange, solved);
  return solved;
}

}  // namespace

PairSettings pair_settings(const NumericalSettings& settings) {
  PairSettings result;
  result.tolerance = std::max(result.tolerance, pair_share * settings.quadrature_tolerance);
  return result;
}

SolvedFields solve_fields(const Model& model, const Discretisation& discretisation, const State& state,
                          Instruments& instruments, const SolvedFields* previous, Limit limit, Shapes shapes) {
  return discretisation.partition().ranks().collective(
      [&] { return solve_all(model, discretisation, state, instruments, previous, limit, shapes); });
}

Evaluation evaluate(const Model& model, const Discretisation& discretisation, const State& state,
                    Instruments& instruments, const Evaluation* previous, Limit limit) {
  Evaluation evaluation{solve_fields(model, discretisation, state, instruments, previous, limit), {}};
  const auto diagnosed = [&](std::size_t a, const VesicleDiagnostics* with_same_operators) {
    const VesicleSolution& solution = evaluation.vesicles[a];
    VesicleDiagnostics diagnostics =
        diagnose(model, model.vesicles[a], discretisation.vesicle(a), discretisation.settings().quadrature_tolerance,
                 state.vesicles[a], solution, evaluation.fields.vesicles[a], with_same_operators);
    diagnostics.rheology = find_rheology(model, model.vesicles[a], state.time, limit, state.vesicles[a], solution,
                                         evaluation.fields.vesicles[a]);
    return diagnostics;
  };
  evaluation.diagnostics.vesicles = discretisation.partition().of_all(
      state.vesicles.size(),
      [&](std::size_t a) {
        const bool same = previous != nullptr && previous->vesicles[a].membrane == evaluation.vesicles[a].membrane;
        return diagnosed(a, same ? &previous->diagnostics.vesicles[a] : nullptr);
      },
      // An image has no operators of its own.
      [&](const VesicleDiagnostics& of_original, std::size_t a) { return diagnosed(a, &of_original); });
  report_crossings(state, state.time, evaluation);
  return evaluation;
}

Evaluation without_operators(Evaluation evaluation) {
  for (VesicleSolution& vesicle : evaluation.vesicles) {
    vesicle.membrane.reset();
    vesicle.recycled = {};
    vesicle.force_of_effects = {};
  }
  evaluation.interaction.reset();
  return evaluation;
}

}  // namespace vehd
