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
  /// Extent of that ellipsoid along a direction over its root-mean-square extent across.
  /// @param direction  of any length but zero
  [[nodiscard]] double aspect_ratio_along(const Vector3& direction) const;
};

/// The moments of the volume within a surface.
/// Accuracy: spectral; axes of ellipsoids to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Gauss's theorem
VolumeMoments volume_moments(const Surface& surface);

/// Velocity of the centroid of the volume when the surface moves.
/// @param velocity  of its points, [n_points x 3]
/// Accuracy: spectral; for a moving ellipsoid to 1e-12 (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: Reynolds' transport theorem
Vector3 centroid_velocity(const Surface& surface, const VolumeMoments& moments, const Matrix& velocity);

/// Rotation of a vesicle about an axis, positive by the right-hand rule; frequencies in revolutions per time.
struct Turning {
  double angle = 0.0;     ///< ψ of its long axis across the axis, in (−π/2, π/2]
  double shape = 0.0;     ///< frequency of its long axis: tumbling
  double membrane = 0.0;  ///< frequency of material points about the shape: tank-treading
};

/// Angle, tumbling and tank-treading frequencies about an axis. With ψ the angle of the longer principal axis of the
/// second moments across it, from +x (or +z for an axis nearly along x) projected onto the plane across the axis, and A
/// the best linear fit v − v_c ≈ A (x − centroid) over the surface,
///   tumbling dψ/dt/(2π), tank-treading √(det A′ − (tr A′/2)²)/(2π) with the sign of the rotation in A′,
/// A′ = A minus the rotation dψ/dt. Exact if v is linear in x, as in the flow of an ellipsoid whose points move on
/// ellipses. A shape that is round about the axis has ψ = 0 and does not tumble; tank-treading is 0 if A′ deforms
/// faster than it turns.
/// @param relative_velocity  of the points to the centroid, v − v_c, [n_points x 3]
/// @param axis               of any length but zero
/// Accuracy: spectral; for turning ellipsoids whose membrane circulates to 1e-10
/// (tests/stepping/evaluation/volume_moments_test.cpp)
/// Source: the flow on an ellipsoid is that of Keller and Skalak 1982
Turning turning(const Surface& surface, const VolumeMoments& moments, const Matrix& relative_velocity,
                const Vector3& axis);

/// s_2 … s_6 of the radius r = a(1 + Σ s_l P_l(cos γ)) about a centre, γ the angle from an axis, averaged over the
/// azimuth:
///   a s_l = (2l + 1)/(4π) ∮ r P_l(cos γ) dΩ,   dΩ = (x·n)/r³ dA.
/// Every ray from the centre must meet the surface only once for these to be the amplitudes of the radius.
/// @param axis  of any length but zero
/// Accuracy: spectral; 1e-10 for shapes of these modes (tests/stepping/evaluation/volume_moments_test.cpp)
std::array<double, 5> shape_modes(const Surface& surface, const Vector3& centre, const Vector3& axis);

}  // namespace vehd
