#pragma once

#include <array>

#include "bie/geometry/surface.hpp"

namespace vehd {

/// Centroid and second moments of the volume within a closed surface.
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

/// The moments of the volume within a surface.
/// Accuracy: spectral; axes of ellipsoids to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Gauss's theorem
VolumeMoments volume_moments(const Surface& surface);

/// d/dt of the centroid of the volume when the surface moves.
/// @param velocity  of its points, [n_points x 3]
/// Accuracy: spectral; of a moving ellipsoid to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Reynolds' transport theorem
Vector3 centroid_velocity(const Surface& surface, const VolumeMoments& moments, const Matrix& velocity);

/// How a vesicle turns about an axis, in revolutions per time, positive by the right-hand rule.
struct Turning {
  double shape = 0.0;     ///< of its long axis across the axis: tumbling
  double membrane = 0.0;  ///< of material points about the shape: tank-treading
};

/// From the second moments across the axis: ψ the angle of the longer of their two principal axes, A the best linear
/// fit v − v_c ≈ A (x − centroid) over the surface,
///   tumbling dψ/dt/(2π), tank-treading √(det A′ − (tr A′/2)²)/(2π) with the sign of the rotation in A′,
/// A′ = A less the rotation dψ/dt. Exact where v is linear in x, as in the flow of an ellipsoid whose points run on
/// ellipses. A shape that is round about the axis does not tumble; where A′ deforms faster than it turns nothing
/// treads.
/// @param velocity  of the points, [n_points x 3]
/// @param axis      of any length but zero
/// Accuracy: spectral; of turning ellipsoids whose membrane circulates to 1e-12
/// (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: the flow on an ellipsoid is that of Keller and Skalak 1982
Turning turning(const Surface& surface, const VolumeMoments& moments, const Matrix& velocity, const Vector3& axis);

/// s_2 … s_6 of the radius r = a(1 + Σ s_l P_l(cos γ)) about a centre, γ the angle from an axis; of what is not
/// axisymmetric about it the mean over the azimuth:
///   a s_l = (2l + 1)/(4π) ∮ r P_l(cos γ) dΩ,   dΩ = (x·n)/r³ dA.
/// The amplitudes of the radius where every ray from the centre meets the surface once.
/// @param axis  of any length but zero
/// Accuracy: spectral; 1e-10 of shapes of these modes (tests/stepping/evaluation/volume_moments_test.cpp)
std::array<double, 5> shape_modes(const Surface& surface, const Vector3& centre, const Vector3& axis);

}  // namespace vehd
