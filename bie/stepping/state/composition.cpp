#include "bie/stepping/state/composition.hpp"

#include <algorithm>
#include <utility>

#include "bie/physics/bending.hpp"
#include "bie/physics/electric.hpp"
#include "bie/physics/tension.hpp"

namespace vehd {

namespace {

void append(std::vector<EffectDescription>& effects, EffectDescription effect) {
  const bool known = std::any_of(effects.begin(), effects.end(), [&](const auto& e) { return e.name == effect.name; });
  if (!known) effects.push_back(std::move(effect));
}

/// Those that bring unknowns.
std::vector<EffectDescription> implicit_effects(const Model& model, const VesicleModel& vesicle) {
  std::vector<EffectDescription> result;
  if (model.mobile && vesicle.bending) result.push_back(bending_description());
  if (model.mobile && vesicle.inextensible) result.push_back(tension_description());
  if (model.mobile && vesicle.viscosity_ratio != 1.0) result.push_back(viscosity_contrast_description());
  if (model.electric) result.push_back(electric_description(electric_parameters(model, vesicle)));
  if (vesicle.reaction) result.push_back(vesicle.reaction->description());
  if (vesicle.by_place) {
    result.push_back(
        {"spatially varying membrane", "C_m, G_m, kappa_B or c as functions of the material point", {}, {}});
  }
  if (model.electric && vesicle.pump) {
    result.push_back({"pump", "J_p in C_m dV_m/dt + G_m V_m + J_p = -sigma_i dphi_i/dn", {}, {}});
  }
  return result;
}

}  // namespace

std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model, const VesicleModel& vesicle) {
  std::vector<std::shared_ptr<const ExplicitEffect>> result;
  if (model.flow) result.push_back(std::make_shared<LinearFlowEffect>(*model.flow));
  result.insert(result.end(), vesicle.effects.begin(), vesicle.effects.end());
  result.insert(result.end(), model.effects.begin(), model.effects.end());
  return result;
}

std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model) {
  std::vector<std::shared_ptr<const ExplicitEffect>> result;
  if (model.flow) result.push_back(std::make_shared<LinearFlowEffect>(*model.flow));
  for (const VesicleModel& vesicle : model.vesicles) {
    result.insert(result.end(), vesicle.effects.begin(), vesicle.effects.end());
  }
  result.insert(result.end(), model.effects.begin(), model.effects.end());
  return result;
}

std::vector<EffectDescription> effects_of(const Model& model) {
  std::vector<EffectDescription> result;
  for (const VesicleModel& vesicle : model.vesicles) {
    for (EffectDescription& effect : implicit_effects(model, vesicle)) append(result, std::move(effect));
  }
  if (!model.mobile) return result;
  for (const auto& effect : explicit_effects(model)) append(result, effect->description());
  if (model.contact) append(result, contact_description());
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
  Model active = model;
  if (!electric_active) active.electric.reset();
  active.vesicles = {vesicle};
  LayerSelection result;
  for (const EffectDescription& effect : effects_of(active)) {
    for (const OperatorNeed& need : effect.operators) result.*need.layer = true;
  }
  // A frozen shape has no velocity.
  if (!model.mobile) result.stokes_single = false;
  return result;
}

std::optional<double> next_discontinuity(const Model& model, double time) {
  std::optional<double> result;
  const auto add = [&](const std::optional<double>& discontinuity) {
    if (discontinuity) result = std::min(*discontinuity, result.value_or(*discontinuity));
  };
  if (model.electric) add(model.electric->waveform.next_discontinuity(time));
  for (const VesicleModel& vesicle : model.vesicles) {
    if (vesicle.pump) add(vesicle.pump->next_discontinuity(time));
  }
  for (const auto& effect : explicit_effects(model)) add(effect->next_discontinuity(time));
  return result;
}

bool jumps_at(const Model& model, double time) {
  if (model.electric && model.electric->waveform.jumps_at(time)) return true;
  const auto pump_jumps = [&](const VesicleModel& vesicle) { return vesicle.pump && vesicle.pump->jumps_at(time); };
  if (std::any_of(model.vesicles.begin(), model.vesicles.end(), pump_jumps)) return true;
  const auto effects = explicit_effects(model);
  return std::any_of(effects.begin(), effects.end(), [&](const auto& effect) { return effect->jumps_at(time); });
}

}  // namespace vehd
