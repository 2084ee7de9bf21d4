#pragma once

#include "bie/sphere/grid.hpp"

/// Steps along great circles of the unit sphere, for which the poles are ordinary points.
namespace vehd {

/// A point of the unit sphere.
struct SpherePoint {
  double theta = 0.0;
  double phi = 0.0;
};

/// Point of a grid node.
SpherePoint point_of(const SphereGrid& grid, Index node);
/// Point in the direction of a nonzero vector.
SpherePoint point_of(const Vector3& vector);

/// Unit vector of a point.
Vector3 direction(const SpherePoint& point);

/// End of the great-circle arc that leaves a unit vector along a tangent and is as long as the tangent.
Vector3 along_great_circle(const Vector3& from, const Vector3& tangent);

/// A point with its frame (r̂, e_θ, e_φ).
struct TangentFrame {
  SpherePoint point;
  Vector3 radial, e_theta, e_phi;

  explicit TangentFrame(const SpherePoint& point);
  /// End of the great-circle arc from the point along `step`, in (e_θ, e_φ), as long as the step; radians.
  [[nodiscard]] Vector3 moved(const Eigen::Vector2d& step) const;
};

/// Largest |m| with a nonzero coefficient among those of one field, [n_coefficients]; 0 for a field of zeros.
int azimuthal_order_of(const Vector& coefficients);

}  // namespace vehd
