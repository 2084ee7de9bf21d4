#pragma once

#include "meshes/frozen_shape.hpp"

namespace vehd::meshes {

/// Points of a membrane, evenly in angle and finer than its grid, poles included: [3 x n].
Eigen::Matrix3Xd surface_samples(const FrozenShape& shape);

}  // namespace vehd::meshes
