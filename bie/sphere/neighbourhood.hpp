#pragma once

#include "bie/sphere/grid.hpp"

/// Walks on the unit sphere that know no pole, and fields around a point.
namespace vehd {

/// A point of the unit sphere.
struct SpherePoint {
  double theta = 0.0;
  double phi = 0.0;
};

SpherePoint point_of(const SphereGrid& grid, Index node);

/// The unit vector of a point.
Vector3 direction(const SpherePoint& point);

/// The end of a great circle that leaves the point along the step, in its frame (e_θ, e_φ).
/// @param step  not zero
SpherePoint end_of_walk(const SpherePoint& from, const Eigen::Vector2d& step);

/// Largest |m| with a coefficient that is not zero.
int azimuthal_order_of(const Vector& coefficients);

/// A field with covariant derivatives in the frame (e_θ, e_φ) of one point.
struct PointDerivatives {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// By differences along great circles: the value is exact, derivatives have eight digits.
PointDerivatives derivatives_at(const Vector& coefficients, const SpherePoint& point, int azimuthal_order);

}  // namespace vehd
