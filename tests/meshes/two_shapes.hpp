#pragma once

#include <array>
#include <limits>

#include "tests/meshes/shapes.hpp"

/// Two membranes without symmetry side by side.
namespace vehd::meshes::testing {

/// Coefficients of two shapes of different form and size, rotated relative to each other and to the axes; the gap
/// between their nearest points has the direction (1, 2, 4).
inline std::array<Eigen::MatrixXd, 2> two_positions(double gap, int degree = 12) {
  const Point along = Point(1.0, 2.0, 4.0).normalized();
  const Matrix3 rotation = general_rotation();
  const Field first = [&](const Point& r) {
    const Point stretched = rotation * Point(1.0, 0.85, 1.3).asDiagonal() * r;
    return Point((1.0 + 0.08 * r.x() * r.y() + 0.06 * r.z() * r.x() * r.y()) * stretched);
  };
  const Field second = [&](const Point& r) {
    const Point stretched = rotation.transpose() * Point(0.7, 0.9, 0.8).asDiagonal() * r;
    return Point((1.0 - 0.1 * r.x() * r.z() + 0.05 * r.y()) * stretched);
  };
  const auto farthest = [](const Field& shape, const Point& direction) {
    Point result = Point::Zero();
    double reach = -std::numeric_limits<double>::max();
    for_each_sphere_point(120, [&](const Point& r, double) {
      const Point x = shape(r);
      if (x.dot(direction) <= reach) return;
      reach = x.dot(direction);
      result = x;
    });
    return result;
  };
  const Point way = farthest(first, along) + gap * along - farthest(second, -along);
  return {project(degree, first), project(degree, [&](const Point& r) { return Point(way + second(r)); })};
}

inline std::array<FrozenShape, 2> two_shapes(double gap) {
  const std::array<Eigen::MatrixXd, 2> positions = two_positions(gap);
  return {FrozenShape(positions[0]), FrozenShape(positions[1])};
}

}  // namespace vehd::meshes::testing
