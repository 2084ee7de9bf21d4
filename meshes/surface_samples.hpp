#pragma once

#include "meshes/frozen_shape.hpp"

namespace vehd::meshes {

/// Sample points of a membrane, evenly spaced in θ and φ and finer than its grid, poles included: [3 x n].
Eigen::Matrix3Xd surface_samples(const FrozenShape& shape);

}  // namespace vehd::meshes
