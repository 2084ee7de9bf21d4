#pragma once

#include <array>

#include "bie/support/types.hpp"

/// Images of Stokes kernels in a no-slip plane, evaluated at the mirror image X of a target: s = X − y, and the flow at
/// the target is the mirror image of the flow computed here. The target is `height` above the plane and the source h =
/// −(height + n·s). Both heights are ≤ |s|, so that no term is more singular than the free kernel. Pointwise, no
/// quadrature. Real is a number or an array with one number for each of several nodes.
namespace vehd {

/// A target, given by its mirror image X.
struct MirroredTarget {
  Vector3 normal;  ///< of the plane, unit
  double height;   ///< of the target above the plane; X is as far below it
};

/// Image of a point force f, prefactor that of the Stokes single layer:
///   −(1/s + 2zh/s³) f + [(6zh/s⁵ − 1/s³) s·f − 2z n·f/s³] s + [2 n·f/s − 2h s·f/s³] n.
/// Accuracy: rounding; Blake's tensor and zero velocity on the plane to 1e-12 (tests/potentials/no_slip_test.cpp)
/// Source: Blake 1971
template <class Real>
std::array<Real, 3> no_slip_flow(const MirroredTarget& target, const Real& sx, const Real& sy, const Real& sz,
                                 const Real& inverse, const Real& fx, const Real& fy, const Real& fz) {
  const Vector3& n = target.normal;
  const double z = target.height;
  const Real h = -(z + sx * n[0] + sy * n[1] + sz * n[2]);
  const Real inverse2 = inverse * inverse, zh = 2.0 * z * h * inverse2;
  const Real along = (sx * fx + sy * fy + sz * fz) * inverse2, normal = fx * n[0] + fy * n[1] + fz * n[2];
  const Real of_f = -inverse * (1.0 + zh);
  const Real of_s = inverse * ((3.0 * zh - 1.0) * along - 2.0 * z * normal * inverse2);
  const Real of_n = 2.0 * inverse * (normal - h * along);
  return {of_f * fx + of_s * sx + of_n * n[0], of_f * fy + of_s * sy + of_n * n[1],
          of_f * fz + of_s * sz + of_n * n[2]};
}

/// Image of the kernel of the Stokes double layer for a velocity v, prefactor that of the layer. With a normal or area
/// vector a at the source and Q = (v aᵀ + a vᵀ)/2 it is
///   −4zh Qs/s⁵ + [(10zh/s² − 1) s·Qs + 2z² tr Q] s/s⁵ − 2h s·Qs n/s⁵.
/// For a constant v its integral over a closed surface is zero outside, as that of the free kernel.
/// Accuracy: rounding (tests/potentials/no_slip_test.cpp)
/// Source: no_slip_flow differentiated with respect to the source point, plus the image of a source of fluid
template <class Real>
std::array<Real, 3> no_slip_double_flow(const MirroredTarget& target, const Real& sx, const Real& sy, const Real& sz,
                                        const Real& inverse, const Real& ax, const Real& ay, const Real& az,
                                        const Real& vx, const Real& vy, const Real& vz) {
  const Vector3& n = target.normal;
  const double z = target.height;
  const Real h = -(z + sx * n[0] + sy * n[1] + sz * n[2]);
  const Real inverse2 = inverse * inverse, inverse5 = inverse2 * inverse2 * inverse;
  const Real sv = sx * vx + sy * vy + sz * vz, sa = sx * ax + sy * ay + sz * az, both = sv * sa;
  const Real of_q = -2.0 * z * h * inverse5;  // half of −4zh/s⁵, because Qs = ½ (sa v + sv a)
  const Real of_s = inverse5 * ((10.0 * z * h * inverse2 - 1.0) * both + 2.0 * z * z * (ax * vx + ay * vy + az * vz));
  const Real of_n = -2.0 * h * both * inverse5;
  return {of_q * (sa * vx + sv * ax) + of_s * sx + of_n * n[0], of_q * (sa * vy + sv * ay) + of_s * sy + of_n * n[1],
          of_q * (sa * vz + sv * az) + of_s * sz + of_n * n[2]};
}

}  // namespace vehd
