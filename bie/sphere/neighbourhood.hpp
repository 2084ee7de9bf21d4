#pragma once

#include "bie/sphere/grid.hpp"

/// Walks on the unit sphere that know no pole.
namespace vehd {

/// A point of the unit sphere.
struct SpherePoint {
  double theta = 0.0;
  double phi = 0.0;
};

/// The point of a node of the grid.
SpherePoint point_of(const SphereGrid& grid, Index node);
/// The point in the direction of a vector of any length but zero.
SpherePoint point_of(const Vector3& vector);

/// The unit vector of a point.
Vector3 direction(const SpherePoint& point);

/// The end of a great circle that leaves a unit vector along a tangent, as long as that.
Vector3 along_great_circle(const Vector3& from, const Vector3& tangent);

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

}  // namespace vehd
