#include "bie/estimate/plan.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/scene/waveforms.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/stepping/time/step_control.hpp"

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

/// The model without one of its effects.
Model without(Model model, const EffectRow& row) {
  const auto erase_from = [&](auto& effects) {
    std::erase_if(effects, [&](const auto& effect) { return effect->description().name == row.name; });
  };
  for (VesicleModel& vesicle : model.vesicles) {
    if (row.remove != nullptr) row.remove(model, vesicle);
    erase_from(vesicle.effects);
  }
  erase_from(model.effects);
  return model;
}

/// Independent coefficients per scalar field.
std::int64_t independent_coefficients(const Symmetry& symmetry, int order) {
  if (symmetry.axisymmetric) return order + 1;
  const std::int64_t all = std::int64_t{order + 1} * (order + 1);
  return (all + symmetry.group_order() - 1) / symmetry.group_order();
}

/// The model without its electric part if nothing ever charges a membrane: a run then assembles and solves none of it.
Model without_idle_field(const Model& model, const Problem& problem) {
  Model result = model;
  const bool pumps = std::ranges::any_of(result.vesicles, [](const VesicleModel& v) { return v.pump.has_value(); });
  const bool charged = std::ranges::any_of(
      problem.start, [](const StartMembrane& membrane) { return !membrane.potential.given.isZero(0.0); });
  if (result.electric && result.electric->field.isZero(0.0) && !pumps && !charged) result.electric.reset();
  return result;
}

/// Number of vesicles that need an operator; images of others need none.
std::size_t vesicles_with(const OperatorFlag& op, const Model& model, const Exchange& exchange) {
  std::size_t count = 0;
  for (std::size_t a = 0; a < model.vesicles.size(); ++a) {
    if (!exchange.is_image(a) && needed_layers(model, model.vesicles[a], true).*op.flag) ++count;
  }
  return count;
}

/// Number of fields that the solves of a step find, for all vesicles but images.
std::size_t count_unknown_fields(const Model& model, const Exchange& exchange) {
  std::size_t count = 0;
  for (std::size_t a = 0; a < model.vesicles.size(); ++a) {
    if (exchange.is_image(a)) continue;
    Model one = model;
    one.vesicles = {model.vesicles[a]};
    for (const EffectDescription& effect : effects_of(one)) count += effect.unknowns.size();
  }
  return count;
}

std::string difference_text(const Scene& scene, const Model& model, const Model& reduced, const RunPlan& plan,
                            std::size_t n_unknowns) {
  std::vector<std::string> parts;
  std::vector<std::string> saved;
  for (const OperatorFlag& op : kOperators) {
    if (vesicles_with(op, model, {}) > 0 && vesicles_with(op, reduced, {}) == 0) saved.emplace_back(op.name);
  }
  if (!saved.empty()) parts.push_back(fmt::format("no {}", fmt::join(saved, ", ")));
  if (n_unknowns > 0) parts.push_back(fmt::format("{} fewer unknown field{}", n_unknowns, n_unknowns > 1 ? "s" : ""));
  const Problem problem = problem_of(scene, reduced);
  const std::string symmetry = symmetry_text(problem.symmetry, problem.frame);
  if (symmetry != plan.symmetry) parts.push_back("symmetry: " + symmetry);
  return parts.empty() ? "nothing but its own term" : fmt::format("{}", fmt::join(parts, "; "));
}

/// Number of targets at the start for each way of evaluating layers between vesicles.
std::map<std::string, std::uint64_t> pair_targets_of(const Problem& problem, const MembraneSpace& space) {
  const std::optional<Wall>& wall = problem.model.wall;
  if (problem.start.size() < 2 && !wall) return {};
  std::vector<Matrix> positions;
  for (const StartMembrane& start : problem.start) {
    positions.push_back(resize_order(start.position, problem.settings.order));
  }
  // Without layers the targets are only classified.
  std::vector<InteractingMembrane> membranes;
  for (const Matrix& position : positions) {
    membranes.push_back({position, space.targets(), {}, space.subspace().symmetry()});
  }
  Instruments instruments;
  const Exchange& exchange = problem.symmetry.exchange;
  const Interaction classified(membranes, pair_settings(problem.settings), instruments,
                               Partition({}, std::vector<double>(membranes.size(), 1.0), exchange.originals()),
                               exchange, {}, wall);
  return instruments.pair_targets();
}

/// Distinct acting waveforms of all vesicles.
std::vector<Waveform> waveforms_of(const Scene& scene) {
  std::vector<Waveform> result;
  for (const Scene& one : each_alone(scene)) {
    for (const ActingWaveform& acting : acting_waveforms(one)) {
      const Waveform waveform = waveform_of(acting.waveform);
      if (std::ranges::find(result, waveform) == result.end()) result.push_back(waveform);
    }
  }
  return result;
}

/// Lower bound on the number of times at which steps must end before the end of the run: jumps of the acting waveforms
/// and, with fixed steps, snapshots.
double fewest_events(const Scene& scene) {
  const double end = scene.numerics.end_time;
  double count = scene.numerics.tolerance ? 0.0 : events_of(scene).snapshots.count(end);
  for (const Scene& one : each_alone(scene)) {
    for (const ActingWaveform& acting : acting_waveforms(one)) {
      if (!alternates(acting.waveform)) count += fewest_steps(acting.waveform, end);
    }
  }
  return count;
}

/// Counts jumps and fixed steps.
void count_steps(const Scene& scene, RunPlan& plan) {
  // More events take too long to enumerate: each then counts as a jump and as one step.
  constexpr double kMostEvents = 1e6;
  const double end = scene.numerics.end_time;
  const bool fixed = !scene.numerics.tolerance;
  if (const double events = fewest_events(scene); events > kMostEvents) {
    plan.n_jumps = std::llround(events);
    if (fixed) plan.n_steps = std::llround(events + end / *scene.numerics.dt);
    return;
  }
  const std::vector<Waveform> waveforms = waveforms_of(scene);
  EventTimes events = fixed ? events_of(scene) : EventTimes{{}, end};
  for (double time = 0.0; time < end;) {
    events.discontinuity.reset();
    for (const Waveform& waveform : waveforms) {
      const auto next = waveform.next_discontinuity(time);
      if (next) events.discontinuity = std::min(*next, events.discontinuity.value_or(*next));
    }
    const StepPlan step = plan_step(time, fixed ? *scene.numerics.dt : end, events);
    if (fixed) plan.n_steps += std::llround((step.event_time - time) / step.dt);
    time = step.event_time;
    if (std::ranges::any_of(waveforms, [=](const Waveform& waveform) { return waveform.jumps_at(time); })) {
      ++plan.n_jumps;
    }
  }
}

}  // namespace

RunPlan plan_of(const Scene& scene) {
  const Model model = model_of(scene);
  const Problem problem = problem_of(scene, model);
  const Model acting = without_idle_field(model, problem);
  const Symmetry& symmetry = problem.symmetry;
  const std::vector<EffectDescription> effects = effects_of(model);
  RunPlan plan;
  plan.groups = dimensionless_groups(scene);
  plan.times = run_times(scene, plan.groups);
  plan.warnings = model_warnings(scene);
  std::erase_if(plan.groups, [](const DimensionlessGroup& group) { return group.unit == "time"; });
  for (const DimensionlessGroup& group : plan.groups) plan.si_of_groups.push_back(si_text(scene, group));
  plan.symmetry = symmetry_text(problem.symmetry, problem.frame);
  plan.vesicles = vesicle_names(scene);
  const std::vector<EffectDescription> acting_effects = effects_of(acting);
  for (const EffectRow& row : effect_table()) {
    const auto effect = std::ranges::find(effects, row.name, &EffectDescription::name);
    if (effect == effects.end()) {
      plan.absent.emplace_back(row.name);
      continue;
    }
    const bool acts = std::ranges::count(acting_effects, row.name, &EffectDescription::name) > 0;
    plan.effects.push_back(
        {effect->name, effect->adds,
         difference_text(scene, acting, without(acting, row), plan, acts ? effect->unknowns.size() : 0)});
  }
  for (const OperatorFlag& op : kOperators) {
    const std::size_t n_vesicles = vesicles_with(op, acting, symmetry.exchange);
    if (n_vesicles == 0) continue;
    std::vector<std::string> reasons;
    for (const EffectDescription& effect : effects) {
      for (const OperatorNeed& need : effect.operators) {
        if (need.layer == op.flag) reasons.push_back(need.why);
      }
    }
    plan.operators.push_back({op.name, fmt::format("{}", fmt::join(reasons, "; ")), n_vesicles});
  }
  const MembraneSpace space(problem.settings, symmetry);
  plan.kernel_evaluations =
      evaluations_per_assembly(space.quadrature(), space.targets(), symmetry.reflections, space.fold());
  plan.pair_targets = pair_targets_of(problem, space);
  plan.shapes_per_step = evaluations_per_step(scene.numerics.time_order);
  count_steps(scene, plan);
  plan.unknowns = static_cast<std::int64_t>(count_unknown_fields(acting, symmetry.exchange)) *
                  independent_coefficients(symmetry, scene.numerics.order);
  return plan;
}

}  // namespace vehd
