#pragma once

#include <optional>
#include <vector>

#include "bie/physics/effect.hpp"
#include "bie/stepping/state/model.hpp"
#include "bie/stepping/state/state.hpp"

/// What a step is composed of: everything here follows from which effects the model has.
namespace vehd {

/// Every effect that some vesicle has, implicit ones first, each once.
std::vector<EffectDescription> effects_of(const Model& model);

/// The effects that enter explicitly, those of all vesicles among them.
std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model);
/// Those that act on one vesicle.
std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model, const VesicleModel& vesicle);

/// Nothing electric needs to be done: no field and no V_m on any membrane, and no change of that before the next
/// discontinuity of the waveform or, with Limit::before, at the time of the state and before a jump there.
bool electric_inactive(const Model& model, const State& state, Limit limit = Limit::after);

/// The operators that the effects on one vesicle need; those of the electric problem only while it is active.
LayerSelection needed_layers(const Model& model, const VesicleModel& vesicle, bool electric_active);

/// The next time after `time` at which a step should end because some effect changes abruptly.
std::optional<double> next_discontinuity(const Model& model, double time);

/// Does some effect jump at this time?
bool jumps_at(const Model& model, double time);

}  // namespace vehd
