#pragma once

#include <functional>

#include "fem_check/discretisation.hpp"

namespace vehd::fem_check {

/// Values at points of the volume, [components x points]; NaN if no cell is found for a point: beyond the outer sphere,
/// or in a fold of a thin shape where the inversion of the map fails.
/// @param values  evaluates at located points
Eigen::MatrixXd at_samples(const Discretisation& discretisation, const Vectors& points,
                           const std::function<Eigen::MatrixXd(const VolumePoints&)>& values);

}  // namespace vehd::fem_check
