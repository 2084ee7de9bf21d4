#pragma once

#include "bie/physics/model.hpp"
#include "bie/scene/scene.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

/// Model with the effects of the scene, in laboratory coordinates.
Model model_of(const Scene& scene);

/// Numerical settings from [numerics]; the others keep their defaults.
NumericalSettings settings_of(const Scene& scene);

/// Fixed steps, or steps that a tolerance controls.
StepControl step_control_of(const Scene& scene);

}  // namespace vehd
