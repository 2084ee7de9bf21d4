#include "bie/stepping/state/composition.hpp"

#include <algorithm>
#include <utility>

namespace vehd {

std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model, const VesicleModel& vesicle) {
  std::vector<std::shared_ptr<const ExplicitEffect>> result;
  if (model.flow) result.push_back(std::make_shared<LinearFlowEffect>(*model.flow));
  result.insert(result.end(), vesicle.effects.begin(), vesicle.effects.end());
  result.insert(result.end(), model.effects.begin(), model.effects.end());
  return result;
}

namespace {

void append(std::vector<EffectDescription>& effects, EffectDescription effect) {
  if (std::ranges::count(effects, effect.name, &EffectDescription::name) == 0) effects.push_back(std::move(effect));
}

/// The effects that rows of the effect table make.
std::vector<MadeEffect> registered_effects(const Model& model, const VesicleModel& vesicle) {
  std::vector<MadeEffect> result;
  for (const EffectRow& row : effect_table()) {
    if (MadeEffect made = row.made == nullptr ? nullptr : row.made(model, vesicle)) result.push_back(std::move(made));
  }
  return result;
}

std::vector<MadeEffect> effects_on(const Model& model, const VesicleModel& vesicle) {
  std::vector<MadeEffect> result = registered_effects(model, vesicle);
  for (auto& effect : explicit_effects(model, vesicle)) result.push_back(std::move(effect));
  return result;
}

}  // namespace

std::vector<MadeEffect> effects_on_all(const Model& model) {
  std::vector<MadeEffect> result;
  for (const VesicleModel& vesicle : model.vesicles) {
    for (MadeEffect& effect : effects_on(model, vesicle)) result.push_back(std::move(effect));
  }
  return result;
}

std::vector<EffectDescription> effects_of(const Model& model) {
  std::vector<EffectDescription> result;
  for (const VesicleModel& vesicle : model.vesicles) {
    // Flows and forces have no effect on frozen shapes.
    for (const MadeEffect& effect : model.mobile ? effects_on(model, vesicle) : registered_effects(model, vesicle)) {
      append(result, effect->description());
    }
  }
  return result;
}

bool electric_inactive(const Model& model, const State& state, Limit limit) {
  if (!model.electric) return false;
  const Waveform& waveform = model.electric->waveform;
  // A pump charges a membrane that has no V_m yet.
  const auto pumps = [](const VesicleModel& vesicle) { return vesicle.pump.has_value(); };
  if (std::any_of(model.vesicles.begin(), model.vesicles.end(), pumps)) return false;
  const bool quiet =
      limit == Limit::after ? waveform.is_quiet(state.time) : waveform.at(state.time, Limit::before) == 0.0;
  return quiet && std::all_of(state.vesicles.begin(), state.vesicles.end(), [](const VesicleState& vesicle) {
           return vesicle.transmembrane_potential.isZero(0.0) && vesicle.free_charge.isZero(0.0);
         });
}

LayerSelection needed_layers(const Model& model, const VesicleModel& vesicle, bool electric_active) {
  if (model.electric && !electric_active) {
    Model without_field = model;
    without_field.electric.reset();
    return needed_layers(without_field, vesicle, false);
  }
  LayerSelection result;
  for (const MadeEffect& effect : effects_on(model, vesicle)) {
    for (const OperatorNeed& need : effect->description().operators) result.*need.layer = true;
  }
  // A frozen shape has no velocity.
  if (!model.mobile) result.stokes_single = false;
  return result;
}

std::optional<double> next_discontinuity(const Model& model, double time) {
  std::optional<double> result;
  for (const MadeEffect& effect : effects_on_all(model)) {
    const std::optional<double> next = effect->next_discontinuity(time);
    if (next) result = std::min(*next, result.value_or(*next));
  }
  return result;
}

bool jumps_at(const Model& model, double time) {
  return std::ranges::any_of(effects_on_all(model), [&](const MadeEffect& effect) { return effect->jumps_at(time); });
}

}  // namespace vehd
