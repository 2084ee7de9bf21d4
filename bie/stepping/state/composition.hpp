#pragma once

#include <optional>
#include <vector>

#include "bie/physics/model.hpp"
#include "bie/stepping/state/state.hpp"

/// Composition of a step: everything here follows from the effects of the model.
namespace vehd {

/// The effects on all vesicles, one after the other: those of the effect_table, implicit ones first, then the others
/// that the model lists.
std::vector<MadeEffect> effects_on_all(const Model& model);
/// The effects on one vesicle that enter explicitly.
std::vector<std::shared_ptr<const ExplicitEffect>> explicit_effects(const Model& model, const VesicleModel& vesicle);

/// Every effect that some vesicle has in a step, each once.
std::vector<EffectDescription> effects_of(const Model& model);

/// Is the solution of the electric problem zero? That is, no field, pump, V_m or free charge on any membrane, until the
/// next discontinuity of the waveform or, with Limit::before, at the time of the state before a jump there.
bool electric_inactive(const Model& model, const State& state, Limit limit = Limit::after);

/// The operators that the effects on one vesicle need; those of the electric problem only while it is active.
LayerSelection needed_layers(const Model& model, const VesicleModel& vesicle, bool electric_active);

/// The next time after `time` at which a step should end because some effect changes abruptly.
std::optional<double> next_discontinuity(const Model& model, double time);

/// Does some effect jump at this time?
bool jumps_at(const Model& model, double time);

}  // namespace vehd
