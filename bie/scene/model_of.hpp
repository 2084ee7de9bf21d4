#pragma once

#include "bie/scene/scene.hpp"
#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/model.hpp"

namespace vehd {

/// The effects that the scene calls for, in laboratory coordinates.
Model model_of(const Scene& scene);

NumericalSettings settings_of(const Scene& scene);

}  // namespace vehd
