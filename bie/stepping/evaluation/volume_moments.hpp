#pragma once

#include "bie/geometry/surface.hpp"

namespace vehd {

/// What the volume within a closed surface says of where it is and how it is stretched.
struct VolumeMoments {
  Vector3 centroid = Vector3::Zero();
  /// ∫ (x − centroid)(x − centroid)ᵀ dV / ∫ dV: a²/5 along the semi-axis a of an ellipsoid.
  Matrix3 spread = Matrix3::Zero();

  /// Longest over shortest axis of the ellipsoid with this spread.
  [[nodiscard]] double aspect_ratio() const;
  /// Its extent along a direction over that across, where it is the same in all directions across.
  /// @param direction  of any length but zero
  [[nodiscard]] double aspect_ratio_along(const Vector3& direction) const;
};

/// Of what a surface encloses.
/// Accuracy: spectral; axes of ellipsoids to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Gauss's theorem
VolumeMoments volume_moments(const Surface& surface);

/// d/dt of the centroid of the volume when the surface moves.
/// @param velocity  of its points, [n_points x 3]
/// Accuracy: spectral; of a moving ellipsoid to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Reynolds' transport theorem
Vector3 centroid_velocity(const Surface& surface, const VolumeMoments& moments, const Matrix& velocity);

}  // namespace vehd
