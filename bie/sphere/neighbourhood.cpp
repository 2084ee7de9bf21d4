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

Vector3 along_great_circle(const Vector3& from, const Vector3& tangent) {
  const double length = tangent.norm();
  // sin(x)/x is 1 to rounding there.
  const double sinc = length < 1e-8 ? 1.0 : std::sin(length) / length;
  return std::cos(length) * from + sinc * tangent;
}

Vector3 TangentFrame::moved(const Eigen::Vector2d& step) const {
  return along_great_circle(radial, step.x() * e_theta + step.y() * e_phi);
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

}  // namespace vehd
