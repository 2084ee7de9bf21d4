#pragma once

#include <numbers>

#include "tests/support/fields.hpp"

/// Coefficients of x for the shapes of the tests.
namespace vehd::testing {

/// x = diag(axes) r̂, exact at every order.
inline Matrix ellipsoid(int order, const Vector3& axes) {
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  position(coefficient_index(1, 1), 0) = axes.x() * unit;
  position(coefficient_index(1, -1), 1) = axes.y() * unit;
  position(coefficient_index(1, 0), 2) = axes.z() * unit;
  return position;
}

inline Matrix sphere(int order, double radius = 1.0) { return ellipsoid(order, Vector3::Constant(radius)); }

/// The 2:1 prolate of the paper's Example 2 along z.
inline Matrix prolate(int order) { return ellipsoid(order, {1.0, 1.0, 2.0}); }

inline Matrix translated(Matrix position, const Vector3& by) {
  position.row(0) += std::sqrt(4.0 * std::numbers::pi) * by.transpose();
  return position;
}

/// Shape (33): ρ = 1 + 0.2 exp(−3 Re Y_3^2). Not band-limited: degrees above the order are cut off.
inline Matrix shape_33(int order) {
  const SphereTransform transform(order, make_grid(3 * order));
  const Vector y = transform.synthesize(harmonic(order, 3, 2)) / std::numbers::sqrt2;
  const Vector radius = 1.0 + 0.2 * (-3.0 * y.array()).exp();
  return transform.analyze(radius.asDiagonal() * grid_directions(transform.grid()));
}

/// A disc of radius 1 that is 2 c thick around its middle and some 0.6 thicker further out: x = (sin θ cos φ,
/// sin θ sin φ, cos θ (c + 2.5 sin⁴θ − 1.9 sin⁶θ)). Exact from order 7 up.
inline Matrix dimpled_disc(int order, double c) {
  const SphereTransform transform(order, make_grid(2 * order));
  Matrix points = grid_directions(transform.grid());
  for (Index i = 0; i < points.rows(); ++i) {
    const double r2 = 1.0 - points(i, 2) * points(i, 2);
    points(i, 2) *= c + 2.5 * r2 * r2 - 1.9 * r2 * r2 * r2;
  }
  return transform.analyze(points);
}

/// ρ = 1 + 0.15 Y_{k,k} + chirality · 0.1 (Y_{k+1,−k} + Y_{3,0}), k = fold: the turns by 2π/k, and mirrors y and z if
/// chirality is zero. Not band-limited.
inline Matrix star_shape(int order, int fold, double chirality) {
  const SphereTransform transform(order, make_grid(3 * order, 240));
  const Vector radius =
      1.0 + (transform.synthesize(0.15 * harmonic(order, fold, fold) +
                                  chirality * 0.1 * (harmonic(order, fold + 1, -fold) + harmonic(order, 3, 0))))
                .col(0)
                .array();
  return transform.analyze(radius.asDiagonal() * grid_directions(transform.grid()));
}

constexpr int kAsymmetricDegree = 5;

/// A shape without any symmetry: ρ of degrees up to 4, then stretched, rotated and moved off the origin. Of degree
/// kAsymmetricDegree, hence the same surface at every order from there up.
inline Matrix asymmetric_shape(int order) {
  const SphereTransform transform(kAsymmetricDegree, make_grid(2 * kAsymmetricDegree));
  Vector rho = std::sqrt(4.0 * std::numbers::pi) * harmonic(kAsymmetricDegree, 0, 0);
  rho[coefficient_index(2, 1)] = 0.15;
  rho[coefficient_index(3, 2)] = 0.18;
  rho[coefficient_index(3, -1)] = -0.12;
  rho[coefficient_index(4, -3)] = 0.11;
  rho[coefficient_index(4, 1)] = 0.08;
  const Matrix points = transform.synthesize(rho).col(0).asDiagonal() * grid_directions(transform.grid());
  const Matrix3 map = general_rotation() * Vector3(1.0, 0.9, 1.25).asDiagonal();
  const Matrix position = transform.analyze(points * map.transpose());
  return translated(resize_order(position, order), {0.3, -0.2, 0.5});
}

}  // namespace vehd::testing
