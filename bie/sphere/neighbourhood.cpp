#include "bie/sphere/neighbourhood.hpp"

#include <cmath>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

SpherePoint point_of(const SphereGrid& grid, Index node) {
  return {grid.theta[node / grid.n_phi], grid.phi[node % grid.n_phi]};
}

Vector3 direction(const SpherePoint& point) {
  return {std::sin(point.theta) * std::cos(point.phi), std::sin(point.theta) * std::sin(point.phi),
          std::cos(point.theta)};
}

SpherePoint end_of_walk(const SpherePoint& from, const Eigen::Vector2d& step) {
  const double length = step.norm();
  const double cos_theta = std::cos(from.theta), cos_phi = std::cos(from.phi), sin_phi = std::sin(from.phi);
  const Vector3 south{cos_theta * cos_phi, cos_theta * sin_phi, -std::sin(from.theta)};
  const Vector3 east{-sin_phi, cos_phi, 0.0};
  const Vector3 end =
      std::cos(length) * direction(from) + std::sin(length) / length * (step[0] * south + step[1] * east);
  return {std::atan2(std::hypot(end.x(), end.y()), end.z()), std::atan2(end.y(), end.x())};
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

PointDerivatives derivatives_at(const Vector& coefficients, const SpherePoint& point, int azimuthal_order) {
  // Of the field: truncation 1e-8, rounding of the second differences the same.
  constexpr double kSpacing = 1e-4;
  constexpr int kPoints = 9;
  Vector theta = Vector::Constant(kPoints, point.theta), phi = Vector::Constant(kPoints, point.phi);
  for (int i = 0; i < kPoints; ++i) {
    const Eigen::Vector2d offset(i / 3 - 1, i % 3 - 1);
    if (offset.isZero()) continue;
    const SpherePoint end = end_of_walk(point, kSpacing * offset);
    theta[i] = end.theta;
    phi[i] = end.phi;
  }
  const Vector values = evaluate_harmonics(coefficients, theta, phi, azimuthal_order);
  const auto f = [&](int south, int east) { return values[3 * (south + 1) + east + 1]; };
  PointDerivatives at;
  at.value = f(0, 0);
  at.gradient = Eigen::Vector2d(f(1, 0) - f(-1, 0), f(0, 1) - f(0, -1)) / (2.0 * kSpacing);
  at.hessian(0, 0) = f(1, 0) - 2.0 * f(0, 0) + f(-1, 0);
  at.hessian(1, 1) = f(0, 1) - 2.0 * f(0, 0) + f(0, -1);
  at.hessian(0, 1) = at.hessian(1, 0) = 0.25 * (f(1, 1) - f(1, -1) - f(-1, 1) + f(-1, -1));
  at.hessian /= kSpacing * kSpacing;
  return at;
}

}  // namespace vehd
