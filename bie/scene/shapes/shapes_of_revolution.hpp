#pragma once

#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

/// Shapes of revolution about z with the area 4π and a given reduced volume.
/// Accuracy: area and reduced volume to 1e-10, for a stomatocyte to 1e-9 at degree 48
/// (tests/scene/initial_shape_test.cpp)
namespace vehd {

/// Semi-axes of a prolate ellipsoid, the last along z. @param reduced_volume  above about 0.15
Triple prolate_axes(double reduced_volume);

/// Semi-axes of an oblate ellipsoid, the last along z. @param reduced_volume  above about 0.03
Triple oblate_axes(double reduced_volume);

/// Position coefficients of a biconcave disc, [n_coefficients x 3]. Its profile is
///   ρ = R sin θ,  z = (R/2) cos θ (d + (1 − d) sin² θ):
/// the centre is d R thick, with a dimple for d < 2/3; the rim has the curvature of a spheroid R thick. All
/// coefficients above degree 3 are exactly zero. At the reduced volume 0.65 ∫H² dA is 4π · 1.881.
/// @param reduced_volume  0.41 ... 0.76, from touching poles to a flat top
/// Source: a profile of this project, in the shape of a resting red cell
Matrix biconcave_position(double reduced_volume, int order);

/// Position coefficients of a stomatocyte, open towards −z, [n_coefficients x 3]: an oblate bent around a sphere until
/// its rim becomes a mouth narrower than the cavity,
///   ρ = R (1 + w cos θ) sin α,  z = R (1 + w cos θ) cos α,  α = a sin θ.
/// The wall is 2wR thick at the axis. The bend a = 2.2 leaves a mouth with the half-angle π − a. Coefficients fall
/// faster than any power of the degree.
/// @param reduced_volume  0.1 ... 0.65, from a thin wall to a half-full cavity
/// Source: a family of this project
Matrix stomatocyte_position(double reduced_volume, int order);

}  // namespace vehd
