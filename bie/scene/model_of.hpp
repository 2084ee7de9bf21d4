#pragma once

#include "bie/physics/model.hpp"
#include "bie/scene/scene.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

/// The effects that the scene calls for, in laboratory coordinates.
Model model_of(const Scene& scene);

/// The numerical settings that [numerics] asks for; the rest are the defaults.
NumericalSettings settings_of(const Scene& scene);

/// Fixed steps, or those that a tolerance rules.
StepControl step_control_of(const Scene& scene);

}  // namespace vehd
