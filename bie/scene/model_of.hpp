#pragma once

#include "bie/scene/scene.hpp"
#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/model.hpp"

namespace vehd {

/// The effects that the scene calls for.
Model model_of(const Scene& scene);

NumericalSettings settings_of(const Scene& scene);

/// The symmetry that a run of the scene uses: that of its start, or none where the scene says "off".
Symmetry symmetry_of(const Scene& scene, const Model& model);

/// Tables for a run of the scene.
Discretisation discretisation_of(const Scene& scene, const Model& model);

}  // namespace vehd
