#include "bie/estimate/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/support/memory.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/deferred_correction.hpp"
#include "bie/stepping/discretisation_tables.hpp"
#include "bie/stepping/step_plan.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
namespace {

struct OperatorFlag {
  const char* name;
  bool LayerSelection::*flag;
};
constexpr std::array kOperators = {OperatorFlag{"laplace_single", &LayerSelection::laplace_single},
                                   OperatorFlag{"laplace_double", &LayerSelection::laplace_double},
                                   OperatorFlag{"laplace_adjoint", &LayerSelection::laplace_adjoint},
                                   OperatorFlag{"stokes_single", &LayerSelection::stokes_single},
                                   OperatorFlag{"stokes_double", &LayerSelection::stokes_double}};

constexpr std::array kKnownEffects = {
    "bending",         "inextensibility", "electric field",        "background flow",
    "Poiseuille flow", "gravity",         "spontaneous curvature", "viscosity contrast"};

/// The model without one of its effects.
Model without(const Model& model, const std::string& name) {
  Model result = model;
  if (name == "bending") result.bending.reset();
  if (name == "inextensibility") result.inextensible = false;
  if (name == "electric field") result.electric.reset();
  if (name == "background flow") result.flow.reset();
  if (name == "viscosity contrast") result.viscosity_ratio = 1.0;
  std::erase_if(result.effects, [&](const auto& effect) { return effect->description().name == name; });
  return result;
}

/// Independent coefficients per scalar field.
std::int64_t independent_coefficients(const Symmetry& symmetry, int order) {
  if (symmetry.axisymmetric) return order + 1;
  const std::int64_t all = std::int64_t{order + 1} * (order + 1);
  return (all + symmetry.group_order() - 1) / symmetry.group_order();
}

std::string text_of(const Problem& problem) { return symmetry_text(problem.symmetry, problem.frame); }

std::string difference_text(const Scene& scene, const Model& model, const Model& reduced, const RunPlan& plan,
                            std::size_t n_unknowns) {
  std::vector<std::string> parts;
  const LayerSelection needed = needed_layers(model, true);
  const LayerSelection left = needed_layers(reduced, true);
  std::vector<std::string> saved;
  for (const OperatorFlag& op : kOperators) {
    if (needed.*op.flag && !(left.*op.flag)) saved.emplace_back(op.name);
  }
  if (!saved.empty()) parts.push_back(fmt::format("no {}", fmt::join(saved, ", ")));
  if (n_unknowns > 0) parts.push_back(fmt::format("{} fewer unknown field{}", n_unknowns, n_unknowns > 1 ? "s" : ""));
  const std::string symmetry = text_of(problem_of(scene, reduced));
  if (symmetry != plan.symmetry) parts.push_back("symmetry: " + symmetry);
  return parts.empty() ? "nothing but its own term" : fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

RunPlan plan_of(const Scene& scene) {
  const Model model = model_of(scene);
  const Problem problem = problem_of(scene, model);
  const Symmetry& symmetry = problem.symmetry;
  const std::vector<EffectDescription> effects = effects_of(model);
  RunPlan plan;
  plan.symmetry = text_of(problem);
  std::size_t n_fields = 0;
  for (const EffectDescription& effect : effects) {
    n_fields += effect.unknowns.size();
    plan.effects.push_back({effect.name, effect.adds,
                            difference_text(scene, model, without(model, effect.name), plan, effect.unknowns.size())});
  }
  for (const char* name : kKnownEffects) {
    const auto present = [&](const EffectDescription& effect) { return effect.name == name; };
    if (std::none_of(effects.begin(), effects.end(), present)) plan.absent.emplace_back(name);
  }
  const LayerSelection needed = needed_layers(model, true);
  for (const OperatorFlag& op : kOperators) {
    if (!(needed.*op.flag)) continue;
    std::vector<std::string> reasons;
    for (const EffectDescription& effect : effects) {
      for (const OperatorNeed& need : effect.operators) {
        if (need.layer == op.flag) reasons.push_back(need.why);
      }
    }
    plan.operators.push_back({op.name, fmt::format("{}", fmt::join(reasons, "; "))});
  }
  const Discretisation discretisation(problem.settings, symmetry);
  const Discretisation::Tables& tables = discretisation.tables();
  plan.kernel_evaluations =
      evaluations_per_assembly(tables.quadrature, tables.targets, symmetry.reflections, tables.fold);
  plan.shapes_per_step = evaluations_per_step(scene.numerics.time_order);
  plan.unknowns = static_cast<std::int64_t>(n_fields) * independent_coefficients(symmetry, scene.numerics.order);
  double time = 0.0;
  while (!scene.numerics.tolerance && time < scene.numerics.end_time) {
    const EventTimes events{scene.output.every, scene.numerics.end_time, next_corner(model, time)};
    const StepPlan step = plan_step(time, *scene.numerics.dt, events);
    plan.n_steps += std::lround((step.event_time - time) / step.dt_limit);
    time = step.event_time;
  }
  return plan;
}

namespace {

struct Trial {
  double seconds_per_step = 0.0;  ///< of all steps but the first two
  std::string stops;              ///< why it did not come to its end; empty if it did
};

/// A real run of so many steps and two before them, files and all, in a folder that is gone afterwards.
Trial trial_of(Scene scene, int n_timed) {
  constexpr std::size_t kWarmUp = 2;
  scene.numerics.end_time = static_cast<double>(kWarmUp + n_timed) * *scene.numerics.dt;
  const TemporaryFolder folder("vehd-plan");
  const RunPaths paths{folder.path()};
  make_run_directory(paths);
  Interruption interruption;
  std::vector<std::chrono::steady_clock::time_point> ends;
  const auto note_end = [&ends] { ends.push_back(std::chrono::steady_clock::now()); };
  RunOutcome outcome;
  try {
    outcome = simulate({scene, paths, std::nullopt, Progress::Style::none, note_end}, interruption);
  } catch (const ConvergenceError& error) {
    outcome = {.completed = false, .reason = error.what(), .cannot_step = true};
  }
  if (!outcome.completed && !outcome.cannot_step) throw OutputError(outcome.reason);
  if (outcome.cannot_step || ends.size() <= kWarmUp) return {0.0, outcome.reason};
  const std::chrono::duration<double> timed = ends.back() - ends[kWarmUp - 1];
  return {timed.count() / static_cast<double>(ends.size() - kWarmUp), {}};
}

/// A tolerance finds its own steps and degrees, so runs with looser ones have to tell.
void predict_from_looser_runs(const Scene& scene, RunPlan& plan, CostCache& cache, const MenuBudget& budget) {
  constexpr double kLoosest = 0.1;
  std::vector<double> tolerances;
  for (double tolerance = kLoosest; tolerance > 1.001 * *scene.numerics.tolerance; tolerance /= 10.0) {
    tolerances.push_back(tolerance);
  }
  tolerances.push_back(*scene.numerics.tolerance);
  const MenuRow row = menu_of(scene, tolerances, cache, budget).back();
  plan.stops = row.stops;
  if (!plan.stops.empty()) return;
  plan.n_steps = row.steps;
  plan.seconds_per_step = row.steps > 0 ? row.seconds / static_cast<double>(row.steps) : 0.0;
  plan.memory_bytes = row.memory_bytes;
}

}  // namespace

void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const MenuBudget& budget) {
  if (scene.numerics.tolerance) return predict_from_looser_runs(scene, plan, cache, budget);
  constexpr int kLargestTimed = 32;
  constexpr int kFewSteps = 3, kManySteps = 16;
  constexpr double kSlowStep = 0.3;
  Scene timed = scene;
  timed.numerics.order = std::min(scene.numerics.order, kLargestTimed);
  Trial trial = trial_of(timed, kFewSteps);
  if (trial.stops.empty() && trial.seconds_per_step < kSlowStep) trial = trial_of(timed, kManySteps);
  plan.stops = trial.stops;
  if (!plan.stops.empty()) return;
  const double ratio = double(scene.numerics.order) / timed.numerics.order;
  plan.seconds_per_step = trial.seconds_per_step * std::pow(ratio, 5);
  plan.memory_bytes = static_cast<std::int64_t>(static_cast<double>(peak_memory_bytes()) * std::pow(ratio, 4));
}

}  // namespace vehd
