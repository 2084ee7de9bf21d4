#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "meshes/frozen_shape.hpp"
#include "meshes/gauss_rule.hpp"

/// Shapes of the mesh tests, in harmonic coefficients.
namespace vehd::meshes::testing {

using Field = std::function<Point(const Point& direction)>;

/// Calls visit(direction, weight) at the nodes of a product rule that integrates degree 2n − 1 exactly.
template <typename Visit>
void for_each_sphere_point(int n, const Visit& visit) {
  const GaussRule rule = gauss_rule(n);
  const double step = std::numbers::pi / n;
  for (int j = 0; j < n; ++j) {
    for (int k = 0; k < 2 * n; ++k) visit(direction_of(std::acos(rule.node[j]), k * step), rule.weight[j] * step);
  }
}

/// All harmonics up to a degree as one series.
inline HarmonicSeries all_harmonics(int degree) {
  const int n = (degree + 1) * (degree + 1);
  return HarmonicSeries(Eigen::MatrixXd::Identity(n, n));
}

/// Coefficients [n_coefficients x 3] of a field, by quadrature.
inline Eigen::MatrixXd project(int degree, const Field& field) {
  const HarmonicSeries harmonics = all_harmonics(degree);
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero((degree + 1) * (degree + 1), 3);
  for_each_sphere_point(2 * degree + 16, [&](const Point& direction, double weight) {
    result += weight * harmonics.value(direction) * field(direction).transpose();
  });
  return result;
}

inline Matrix3 general_rotation() {
  return (Eigen::AngleAxisd(0.7, Point::UnitZ()) * Eigen::AngleAxisd(1.1, Point::UnitY()) *
          Eigen::AngleAxisd(-0.4, Point::UnitX()))
      .toRotationMatrix();
}

inline FrozenShape off_centre_sphere() {
  return FrozenShape(project(1, [](const Point& r) { return Point(Point(0.4, -1.3, 0.7) + 1.2 * r); }));
}

inline FrozenShape prolate() {
  return FrozenShape(project(1, [](const Point& r) { return Point(r.x(), r.y(), 2.0 * r.z()); }));
}

/// Shape (33): ρ = 1 + 0.2 exp(−3 Re Y_3^2), truncated at degree 16.
inline FrozenShape shape_33() {
  return FrozenShape(project(16, [](const Point& r) {
    const double y = 0.25 * std::sqrt(105.0 / (2.0 * std::numbers::pi)) * r.z() * (r.x() * r.x() - r.y() * r.y());
    return Point((1.0 + 0.2 * std::exp(-3.0 * y)) * r);
  }));
}

/// Discocyte profile: half thickness cos θ (a + b sin² θ + c sin⁴ θ) at the distance sin θ from the axis. a, b, c are
/// those of a red blood cell, scaled to the reduced volume 0.65.
inline Point disc_point(const Point& r) {
  const double s = 1.0 - r.z() * r.z();
  constexpr double kScale = 1.02203;
  return {r.x(), r.y(), kScale * r.z() * (0.1036 + 1.0013 * s - 0.5614 * s * s)};
}

inline FrozenShape disc() { return FrozenShape(project(5, disc_point)); }

/// The disc tilted in space, its surface coordinates rotated by another rotation: a membrane that has tank-treaded.
inline FrozenShape rotated_disc() {
  const Matrix3 tilt = general_rotation();
  const Matrix3 carried = tilt * tilt;
  return FrozenShape(project(5, [&](const Point& r) { return Point(tilt * disc_point(carried.transpose() * r)); }));
}

/// Shape without symmetry: ρ of several degrees, stretched, rotated and translated.
inline FrozenShape asymmetric() {
  const Matrix3 map = general_rotation() * Point(1.0, 0.9, 1.25).asDiagonal();
  return FrozenShape(project(16, [&](const Point& r) {
    const double rho = 1.0 + 0.15 * r.x() * r.z() + 0.25 * r.z() * (r.x() * r.x() - r.y() * r.y()) +
                       0.2 * r.y() * r.y() * r.y() * r.x();
    return Point(Point(0.3, -0.2, 0.5) + map * (rho * r));
  }));
}

/// The disc bent into a bowl, its centroid outside: straight lines from core to membrane fold.
inline FrozenShape bowl() {
  return FrozenShape(
      project(5, [](const Point& r) { return Point(disc_point(r) + 0.9 * (1.0 - r.z() * r.z()) * Point::UnitZ()); }));
}

struct NamedShape {
  std::string name;
  FrozenShape shape;
};

inline std::vector<NamedShape> all_shapes() {
  return {{"off-centre sphere", off_centre_sphere()},
          {"prolate", prolate()},
          {"shape (33)", shape_33()},
          {"disc", disc()},
          {"rotated disc", rotated_disc()},
          {"asymmetric", asymmetric()}};
}

}  // namespace vehd::meshes::testing
