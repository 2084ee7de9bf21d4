#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Position coefficients of a stomatocyte about z, open towards −z, with the area 4π, [n_coefficients x 3]: an oblate
/// bent around a sphere until its rim is a mouth narrower than the cavity,
///   ρ = R (1 + w cos θ) sin α,  z = R (1 + w cos θ) cos α,  α = a sin θ,
/// whose wall is 2wR thick at the axis. The bend a = 2.2 leaves a mouth of half the angle π − a. Coefficients fall
/// faster than any power of the degree.
/// @param reduced_volume  0.1 ... 0.65, from a thin wall to a cavity half full
/// Accuracy: spectral in the degree; area and reduced volume to 1e-9 at 48 (tests/scene/initial_shape_test.cpp)
/// Source: a family of this project
Matrix stomatocyte_position(double reduced_volume, int order);

}  // namespace vehd
