#pragma once

#include <optional>
#include <vector>

#include "bie/physics/effect.hpp"
#include "bie/stepping/model.hpp"
#include "bie/stepping/state.hpp"

/// What a step is composed of: everything here follows from which effects the model has.
namespace vehd {

/// Every effect that is present, implicit ones first.
std::vector<EffectDescription> effects_of(const Model& model);

/// The effects that enter explicitly.
std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model);

/// No field, no V_m, and no change of that before the next corner of the waveform: nothing electric needs to be done.
bool electric_sleeps(const Model& model, const State& state);

/// No field and no V_m at the time of the state, before a jump of the waveform if there is one then.
bool electric_is_silent(const Model& model, const State& state);

/// The operators that the effects need; those of the electric problem only while it is awake.
LayerSelection needed_layers(const Model& model, bool electric_awake);

/// The next time after `time` at which a step should end because some effect changes abruptly.
std::optional<double> next_corner(const Model& model, double time);

/// Does some effect jump at this time?
bool jumps_at(const Model& model, double time);

}  // namespace vehd
