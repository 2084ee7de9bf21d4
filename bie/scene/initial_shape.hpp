#pragma once

#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Position x(θ, φ) of the initial membrane: coefficients of the scene's order, [n_coefficients x 3]; θ from +z.
/// @throws InputError if the shape file cannot be used
Matrix initial_position(const Scene& scene);

/// Smallest radius of a radial shape over a fine grid; NaN if some radius is not finite.
double smallest_radius(const Scene& scene);

}  // namespace vehd
