#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Position coefficients of a biconcave disc about z with the area 4π, [n_coefficients x 3]. Its profile is
///   ρ = R sin θ,  z = (R/2) cos θ (d + (1 − d) sin² θ):
/// the rim is as thick as the radius R, the centre d times that, with a dimple for d < 2/3. All coefficients above
/// degree 3 are exactly zero. At the reduced volume 0.65 ∫H² dA is 4π · 1.881.
/// @param reduced_volume  0.41 ... 0.76, from touching poles to a flat top
/// Accuracy: area and reduced volume to 1e-10 (tests/scene/initial_shape_test.cpp)
/// Source: a profile of this project, in the shape of a resting red cell
Matrix biconcave_position(double reduced_volume, int order);

}  // namespace vehd
