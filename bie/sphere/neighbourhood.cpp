#include "bie/sphere/neighbourhood.hpp"

#include <array>
#include <cmath>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Of the field: truncation 1e-8, rounding of the second differences the same.
constexpr double kSpacing = 1e-4;

/// Every field at the ends of the steps, which are given in units of the spacing.
template <std::size_t count>
Matrix values_around(const Matrix& coefficients, const SpherePoint& point,
                     const std::array<Eigen::Vector2d, count>& steps, int azimuthal_order) {
  const TangentFrame frame(point);
  Vector theta(count), phi(count);
  for (std::size_t i = 0; i < count; ++i) {
    const SpherePoint end = point_of(frame.moved(kSpacing * steps[i]));
    theta[static_cast<Index>(i)] = end.theta;
    phi[static_cast<Index>(i)] = end.phi;
  }
  return evaluate_harmonics(coefficients, theta, phi, azimuthal_order);
}

}  // namespace

SpherePoint point_of(const SphereGrid& grid, Index node) {
  return {grid.theta[node / grid.n_phi], grid.phi[node % grid.n_phi]};
}

SpherePoint point_of(const Vector3& vector) {
  return {std::atan2(std::hypot(vector.x(), vector.y()), vector.z()), std::atan2(vector.y(), vector.x())};
}

Vector3 direction(const SpherePoint& point) {
  return {std::sin(point.theta) * std::cos(point.phi), std::sin(point.theta) * std::sin(point.phi),
          std::cos(point.theta)};
}

TangentFrame::TangentFrame(const SpherePoint& p)
    : point(p),
      radial(direction(p)),
      e_theta(std::cos(p.theta) * std::cos(p.phi), std::cos(p.theta) * std::sin(p.phi), -std::sin(p.theta)),
      e_phi(-std::sin(p.phi), std::cos(p.phi), 0.0) {}

Vector3 TangentFrame::moved(const Eigen::Vector2d& step) const {
  const double angle = step.norm();
  if (angle == 0.0) return radial;
  return std::cos(angle) * radial + std::sin(angle) / angle * (step.x() * e_theta + step.y() * e_phi);
}

int azimuthal_order_of(const Vector& coefficients) {
  int most = 0;
  for (int n = 1; n <= order_of(coefficients.size()); ++n) {
    for (int m = n; m > most; --m) {
      if (coefficients[coefficient_index(n, m)] != 0.0 || coefficients[coefficient_index(n, -m)] != 0.0) most = m;
    }
  }
  return most;
}

LocalField derivatives_at(const Vector& coefficients, const SpherePoint& point, int azimuthal_order) {
  constexpr int kPoints = 9;
  std::array<Eigen::Vector2d, kPoints> steps;
  for (int i = 0; i < kPoints; ++i) steps.at(static_cast<std::size_t>(i)) = {i / 3 - 1, i % 3 - 1};
  const Vector values = values_around(coefficients, point, steps, azimuthal_order);
  const auto f = [&](int south, int east) { return values[3 * (south + 1) + east + 1]; };
  LocalField at;
  at.value = f(0, 0);
  at.gradient = Eigen::Vector2d(f(1, 0) - f(-1, 0), f(0, 1) - f(0, -1)) / (2.0 * kSpacing);
  at.hessian(0, 0) = f(1, 0) - 2.0 * f(0, 0) + f(-1, 0);
  at.hessian(1, 1) = f(0, 1) - 2.0 * f(0, 0) + f(0, -1);
  at.hessian(0, 1) = at.hessian(1, 0) = 0.25 * (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1));
  at.hessian /= kSpacing * kSpacing;
  return at;
}

LocalSlopes slopes_at(const Matrix& coefficients, const SpherePoint& point, int azimuthal_order) {
  const std::array<Eigen::Vector2d, 5> steps{{{0.0, 0.0}, {1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}}};
  const Matrix values = values_around(coefficients, point, steps, azimuthal_order);
  LocalSlopes at{values.row(0).transpose(), Matrix(values.cols(), 2)};
  at.gradient.col(0) = (values.row(1) - values.row(2)).transpose() / (2.0 * kSpacing);
  at.gradient.col(1) = (values.row(3) - values.row(4)).transpose() / (2.0 * kSpacing);
  return at;
}

}  // namespace vehd
