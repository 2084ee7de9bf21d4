#include "bie/scene/initial_shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/scene/biconcave.hpp"
#include "bie/scene/placement.hpp"
#include "bie/scene/shape_file.hpp"
#include "bie/scene/shape_nodes.hpp"
#include "bie/scene/spheroid.hpp"
#include "bie/scene/stomatocyte.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// x = axes · r̂, whose components are the three harmonics of degree 1: exact, with all other coefficients zero.
Matrix ellipsoid_position(const Triple& axes, int order) {
  Matrix position = Matrix::Zero(n_coefficients(order), 3);
  const double unit = std::sqrt(4.0 * std::numbers::pi / 3.0);
  position(coefficient_index(1, 1), 0) = axes[0] * unit;
  position(coefficient_index(1, -1), 1) = axes[1] * unit;
  position(coefficient_index(1, 0), 2) = axes[2] * unit;
  return position;
}

Vector radius_on(const SphereTransform& of_shape, const ShapeScene& shape) {
  // Of a trial run with a lower degree than that of the modes as well.
  int degree = of_shape.order();
  for (const HarmonicMode& mode : shape.modes) degree = std::max(degree, mode.n);
  const SphereTransform transform(degree, of_shape.grid());
  Matrix coefficients = Matrix::Zero(n_coefficients(degree), 1);
  for (const HarmonicMode& mode : shape.modes) {
    // Re and Im of the complex harmonic are 1/√2 of the real ones.
    coefficients(coefficient_index(mode.n, mode.m), 0) += mode.m == 0 ? mode.a : mode.a / std::numbers::sqrt2;
  }
  const Vector s = transform.synthesize(coefficients).col(0);
  if (!shape.amplitude) return shape.base + s.array();
  return shape.base + *shape.amplitude * (shape.exponent * s.array()).exp();
}

Matrix radial_position(const Scene& scene) {
  const SphereTransform transform = shape_transform(scene.numerics.order);
  const Vector radius = radius_on(transform, scene.shape);
  return without_rounding(position_through(transform, [&](Index i, double theta, double phi) -> Vector3 {
    return radius(i) * Vector3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
  }));
}

InitialMembrane stored_membrane(const Scene& scene) {
  const ShapeFile file(scene);
  InitialMembrane membrane{resize_order(file.position(), scene.numerics.order), {}};
  if (takes_stored_potential(scene)) membrane.potential = resize_order(file.potential(), scene.numerics.order);
  return membrane;
}

InitialMembrane unplaced_membrane(const Scene& scene) {
  const ShapeScene& shape = scene.shape;
  const int order = scene.numerics.order;
  switch (shape.kind) {
    case ShapeKind::ellipsoid:
      return {ellipsoid_position(shape.axes, order), {}};
    case ShapeKind::prolate:
      return {ellipsoid_position(prolate_axes(shape.reduced_volume), order), {}};
    case ShapeKind::oblate:
      return {ellipsoid_position(oblate_axes(shape.reduced_volume), order), {}};
    case ShapeKind::biconcave:
      return {biconcave_position(shape.reduced_volume, order), {}};
    case ShapeKind::stomatocyte:
      return {stomatocyte_position(shape.reduced_volume, order), {}};
    case ShapeKind::radial:
      return {radial_position(scene), {}};
    case ShapeKind::file:
      break;
  }
  return stored_membrane(scene);
}

bool is_of_unit_size(ShapeKind kind) {
  return kind == ShapeKind::prolate || kind == ShapeKind::oblate || kind == ShapeKind::biconcave ||
         kind == ShapeKind::stomatocyte;
}

double size_factor(const ShapeScene& shape, const Matrix& position) {
  if (shape.scale) return *shape.scale;
  if (!shape.area) return 1.0;
  const double area = is_of_unit_size(shape.kind) ? 4.0 * std::numbers::pi : size_of(position).area;
  return std::sqrt(*shape.area / area);
}

}  // namespace

InitialMembrane initial_membrane(const Scene& scene) {
  const ShapeScene& shape = scene.shape;
  InitialMembrane membrane = unplaced_membrane(scene);
  membrane.position *= size_factor(shape, membrane.position);
  if (shape.rotation) {
    const Matrix3 rotation = rotation_matrix(*shape.rotation);
    membrane.position = rotated(membrane.position, rotation);
    if (membrane.potential.size() > 0) membrane.potential = rotated_scalar(membrane.potential, rotation);
  }
  membrane.position = shifted(std::move(membrane.position), shape.centre);
  return membrane;
}

Matrix initial_position(const Scene& scene) { return initial_membrane(scene).position; }

Extremes radius_extremes(const Scene& scene) {
  const Vector radius = radius_on(shape_transform(scene.numerics.order), scene.shape);
  // -fno-trapping-math still allows isfinite; minCoeff alone would skip a NaN.
  for (const double value : radius) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    if (!std::isfinite(value)) return {none, none};
  }
  return {radius.minCoeff(), radius.maxCoeff()};
}

}  // namespace vehd
