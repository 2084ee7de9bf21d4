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
/// The point in the direction of a vector of any length but zero.
SpherePoint point_of(const Vector3& vector);

/// The unit vector of a point.
Vector3 direction(const SpherePoint& point);

/// A point with its frame.
struct TangentFrame {
  SpherePoint point;
  Vector3 radial, e_theta, e_phi;

  explicit TangentFrame(const SpherePoint& point);
  /// The end of a great circle that leaves the point along the step, in (e_θ, e_φ).
  [[nodiscard]] Vector3 moved(const Eigen::Vector2d& step) const;
};

/// Largest |m| with a coefficient that is not zero.
int azimuthal_order_of(const Vector& coefficients);

/// A field with covariant derivatives in the frame (e_θ, e_φ) of one point.
struct LocalField {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// By differences along great circles: the value is exact, derivatives have eight digits.
LocalField derivatives_at(const Vector& coefficients, const SpherePoint& point, int azimuthal_order);

/// Several fields with their gradients in the frame of one point.
struct LocalSlopes {
  Vector value;     ///< [n_fields]
  Matrix gradient;  ///< [n_fields x 2]
};

/// As derivatives_at, of all columns at once and without the Hessian.
LocalSlopes slopes_at(const Matrix& coefficients, const SpherePoint& point, int azimuthal_order);

}  // namespace vehd
