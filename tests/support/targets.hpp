#pragma once

#include <vector>

#include "bie/potentials/foot_point.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "tests/support/fields.hpp"

/// Points on and off a membrane.
namespace vehd::testing {

/// Directions all over the sphere, including both poles and a close neighbour of one.
inline GridAngles scattered_angles(int count) {
  GridAngles angles{Vector(count + 3), Vector(count + 3)};
  angles.theta.head(3) << 0.0, std::numbers::pi, 1e-9;
  angles.phi.head(3) << 0.3, 0.0, -2.0;
  constexpr double kGoldenAngle = 2.399963229728653;
  for (int i = 0; i < count; ++i) {
    angles.theta[i + 3] = std::acos(1.0 - (2.0 * i + 1.0) / count);
    angles.phi[i + 3] = std::remainder(kGoldenAngle * i, 2.0 * std::numbers::pi);
  }
  return angles;
}

/// Points of the surface with outward normals, [n x 3] each.
struct MembranePoints {
  Matrix position, normal;

  /// Points at a height over the membrane, negative inside.
  [[nodiscard]] Matrix at_height(double height) const { return position + height * normal; }
};

inline MembranePoints membrane_points(const Matrix& position, const GridAngles& angles) {
  MembranePoints points{Matrix(angles.theta.size(), 3), Matrix(angles.theta.size(), 3)};
  for (Index i = 0; i < angles.theta.size(); ++i) {
    const PointDerivatives y = point_derivatives(position, {angles.theta[i], angles.phi[i]});
    const Vector3 area = Vector3(y.d1.transpose()).cross(Vector3(y.d2.transpose()));
    points.position.row(i) = y.value;
    points.normal.row(i) = area.transpose() / area.norm();
  }
  return points;
}

/// Heights from rounding to many sizes; `deepest` bounds those inside.
inline std::vector<double> heights(double deepest) {
  std::vector<double> result;
  for (const double distance : {1e-10, 1e-8, 1e-6, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.2, 0.4, 1.0, 3.0, 30.0}) {
    result.push_back(distance);
    if (distance <= deepest) result.push_back(-distance);
  }
  return result;
}

}  // namespace vehd::testing
