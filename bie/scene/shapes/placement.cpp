#include "bie/scene/shapes/placement.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "bie/geometry/surface.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/rotation.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {
namespace {

/// Share of the largest coefficient below which a coefficient is rounding.
constexpr double rounding = 1e-14;
/// Order of a grid for integrals: area elements are not polynomials.
int fine_order(int order) { return std::max(4 * order, 128); }

}  // namespace

SphereTransform shape_transform(int order) {
  constexpr int coarsest = 64;
  return {order, make_grid(std::max(3 * order, coarsest))};
}

Matrix3 rotation_matrix(const AxisAngle& rotation) {
  const Vector3 axis = Vector3(rotation[0], rotation[1], rotation[2]).stableNormalized();
  int quarters = 0;
  const double rest = std::remquo(rotation[3], 90.0, &quarters) * std::numbers::pi / 180.0;
  std::complex<double> turn = std::polar(1.0, rest);
  for (int i = 0; i < (quarters & 3); ++i) turn = {-turn.imag(), turn.real()};
  Matrix3 cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  return turn.real() * Matrix3::Identity() + turn.imag() * cross + (1.0 - turn.real()) * axis * axis.transpose();
}

Matrix rotated(const Matrix& position, const Matrix3& rotation) {
  return without_rounding(rotated_fields(position, rotation) * rotation.transpose());
}

Vector rotated_scalar(const Vector& field, const Matrix3& rotation) {
  return without_rounding(rotated_fields(field, rotation));
}

Matrix shifted(Matrix position, const Triple& by) {
  for (int i = 0; i < 3; ++i) position(0, i) += by[static_cast<std::size_t>(i)] * coefficient_of_one;
  return position;
}

Matrix without_rounding(const Matrix& coefficients) {
  const double smallest = rounding * coefficients.cwiseAbs().maxCoeff();
  return coefficients.unaryExpr([=](double value) { return std::abs(value) <= smallest ? 0.0 : value; });
}

ShapeSize size_of(const Matrix& position) {
  const int order = order_of(position.rows());
  const Surface surface = make_surface(SphereTransform(order, make_grid(fine_order(order))), position);
  return {surface_area(surface), enclosed_volume(surface)};
}

bool is_sphere(const Matrix& position) {
  const int order = order_of(position.rows());
  const Surface shape = make_surface(SphereTransform(order, make_grid(order)), position);
  const double radius = std::sqrt(surface_area(shape) / (4.0 * std::numbers::pi));
  return distance_variation(shape) < thresholds::sphere_variation * radius;
}

}  // namespace vehd
