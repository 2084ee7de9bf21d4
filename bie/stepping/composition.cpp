#include "bie/stepping/composition.hpp"

#include <algorithm>

#include "bie/physics/bending.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/tension.hpp"

namespace vehd {

std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model) {
  std::vector<std::shared_ptr<const ExplicitEffect>> result;
  if (model.flow) result.push_back(std::make_shared<LinearFlowEffect>(*model.flow));
  result.insert(result.end(), model.effects.begin(), model.effects.end());
  return result;
}

std::vector<EffectDescription> effects_of(const Model& model) {
  std::vector<EffectDescription> result;
  if (model.mobile && model.bending) result.push_back(bending_description());
  if (model.mobile && model.inextensible) result.push_back(tension_description());
  if (model.mobile && model.viscosity_ratio != 1.0) result.push_back(viscosity_contrast_description());
  if (model.electric) result.push_back(electric_description(*model.electric));
  if (!model.mobile) return result;
  for (const auto& effect : explicit_effects(model)) result.push_back(effect->description());
  return result;
}

bool electric_sleeps(const Model& model, const State& state) {
  return model.electric && model.electric->waveform.is_quiet(state.time) && state.transmembrane_potential.isZero(0.0);
}

bool electric_is_silent(const Model& model, const State& state) {
  return model.electric && model.electric->waveform.at(state.time, Limit::before) == 0.0 &&
         state.transmembrane_potential.isZero(0.0);
}

LayerSelection needed_layers(const Model& model, bool electric_awake) {
  Model awake = model;
  if (!electric_awake) awake.electric.reset();
  LayerSelection result;
  for (const EffectDescription& effect : effects_of(awake)) {
    for (const OperatorNeed& need : effect.operators) result.*need.layer = true;
  }
  // A frozen shape has no velocity.
  if (!model.mobile) result.stokes_single = false;
  return result;
}

std::optional<double> next_corner(const Model& model, double time) {
  std::optional<double> result;
  const auto add = [&](const std::optional<double>& corner) {
    if (corner) result = std::min(*corner, result.value_or(*corner));
  };
  if (model.electric) add(model.electric->waveform.next_corner(time));
  for (const auto& effect : explicit_effects(model)) add(effect->next_corner(time));
  return result;
}

bool jumps_at(const Model& model, double time) {
  if (model.electric && model.electric->waveform.jumps_at(time)) return true;
  const auto effects = explicit_effects(model);
  return std::any_of(effects.begin(), effects.end(), [&](const auto& effect) { return effect->jumps_at(time); });
}

}  // namespace vehd
