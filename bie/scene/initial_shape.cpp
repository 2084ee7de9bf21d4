#include "bie/scene/initial_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/scene/shape_file.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {
namespace {

/// A radius is no polynomial of bounded degree; a grid this much finer keeps aliasing below the truncation.
int fine_order(int order) { return std::max(3 * order, 64); }

/// x = axes · r̂, whose components are the three harmonics of degree 1: exact, with all other coefficients zero.
Matrix ellipsoid_position(const Triple& axes, int order) {
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  position(coefficient_index(1, 1), 0) = axes[0] * unit;
  position(coefficient_index(1, -1), 1) = axes[1] * unit;
  position(coefficient_index(1, 0), 2) = axes[2] * unit;
  return position;
}

Vector radius_on(const SphereTransform& transform, const ShapeScene& shape) {
  Matrix coefficients = Matrix::Zero(n_coefficients(transform.order()), 1);
  for (const HarmonicMode& mode : shape.modes) {
    // Re and Im of the complex harmonic are 1/√2 of the real ones.
    coefficients(coefficient_index(mode.n, mode.m), 0) += mode.m == 0 ? mode.a : mode.a / std::numbers::sqrt2;
  }
  const Vector s = transform.synthesize(coefficients).col(0);
  if (!shape.amplitude) return shape.base + s.array();
  return shape.base + *shape.amplitude * (shape.exponent * s.array()).exp();
}

Matrix radial_position(const Scene& scene) {
  const int order = scene.numerics.order;
  const SphereTransform transform(order, make_grid(fine_order(order)));
  const SphereGrid& grid = transform.grid();
  const Vector radius = radius_on(transform, scene.shape);
  Matrix points(grid.n_points(), 3);
  for (Index j = 0; j < grid.n_theta; ++j) {
    for (Index k = 0; k < grid.n_phi; ++k) {
      const Index i = j * grid.n_phi + k;
      points(i, 0) = radius(i) * std::sin(grid.theta(j)) * std::cos(grid.phi(k));
      points(i, 1) = radius(i) * std::sin(grid.theta(j)) * std::sin(grid.phi(k));
      points(i, 2) = radius(i) * std::cos(grid.theta(j));
    }
  }
  return transform.analyze(points);
}

}  // namespace

Matrix initial_position(const Scene& scene) {
  switch (scene.shape.kind) {
    case ShapeKind::ellipsoid:
      return ellipsoid_position(scene.shape.axes, scene.numerics.order);
    case ShapeKind::radial:
      return radial_position(scene);
    case ShapeKind::file:
      break;
  }
  return resize_order(read_shape_file(scene.shape.path, scene.shape.time), scene.numerics.order);
}

double smallest_radius(const Scene& scene) {
  const SphereTransform transform(scene.numerics.order, make_grid(fine_order(scene.numerics.order)));
  const Vector radius = radius_on(transform, scene.shape);
  // -fno-trapping-math still allows isfinite; minCoeff alone would skip a NaN.
  for (const double value : radius) {
    if (!std::isfinite(value)) return std::numeric_limits<double>::quiet_NaN();
  }
  return radius.minCoeff();
}

}  // namespace vehd
