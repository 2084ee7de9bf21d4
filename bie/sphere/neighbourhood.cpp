#include "bie/sphere/neighbourhood.hpp"

#include <cmath>

#include "bie/sphere/harmonics.hpp"

namespace vehd {

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
  // Of the field: truncation 1e-8, rounding of the second differences the same.
  constexpr double kSpacing = 1e-4;
  constexpr int kPoints = 9;
  const TangentFrame frame(point);
  Vector theta(kPoints), phi(kPoints);
  for (int i = 0; i < kPoints; ++i) {
    const SpherePoint end = point_of(frame.moved(kSpacing * Eigen::Vector2d(i / 3 - 1, i % 3 - 1)));
    theta[i] = end.theta;
    phi[i] = end.phi;
  }
  const Vector values = evaluate_harmonics(coefficients, theta, phi, azimuthal_order);
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

}  // namespace vehd
