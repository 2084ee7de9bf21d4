#pragma once

#include <functional>

#include "fem_check/discretisation.hpp"

namespace vehd::fem_check {

/// Values at points of the volume, [components x points]; NaN at a point that is found in no cell, as one beyond the
/// outer sphere or one in a fold of a thin shape, where the inverse of the map is not found.
/// @param values  at points that were found
Eigen::MatrixXd at_samples(const Discretisation& discretisation, const Vectors& points,
                           const std::function<Eigen::MatrixXd(const VolumePoints&)>& values);

}  // namespace vehd::fem_check
