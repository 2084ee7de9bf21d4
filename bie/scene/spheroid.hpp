#pragma once

#include "bie/scene/scene.hpp"

/// Ellipsoids of revolution about z with the area 4π.
namespace vehd {

/// Semi-axes of the prolate of that reduced volume, above about 0.15.
/// @return  semi-axes, the last along z; area 4π
/// Accuracy: area and reduced volume to 1e-10 (tests/scene/initial_shape_test.cpp)
Triple prolate_axes(double reduced_volume);

/// Semi-axes of the oblate of that reduced volume, above about 0.03.
/// @return  semi-axes, the last along z; area 4π
/// Accuracy: area and reduced volume to 1e-10 (tests/scene/initial_shape_test.cpp)
Triple oblate_axes(double reduced_volume);

}  // namespace vehd
