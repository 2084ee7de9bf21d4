#include "bie/stepping/evaluation/operator_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

double largest_length(const Matrix& vectors) { return vectors.rowwise().norm().maxCoeff(); }

/// Points from which the membrane looks for itself, in columns: the nodes and behind them the poles.
struct ProbePoints {
  Eigen::Matrix3Xd position, normal;
  Vector spacing;
};

ProbePoints probe_points(const SphereTransform& nodes, const Matrix& position) {
  const Surface s = make_surface(nodes, position);
  const Index n = s.n_points();
  ProbePoints result{Eigen::Matrix3Xd(3, n + 2), Eigen::Matrix3Xd(3, n + 2), Vector(n + 2)};
  result.position.leftCols(n) = s.position.transpose();
  result.normal.leftCols(n) = s.normal.transpose();
  result.spacing.head(n) = (s.area_element * (4.0 * std::numbers::pi / static_cast<double>(n))).cwiseSqrt();
  result.spacing[n] = result.spacing[0];
  result.spacing[n + 1] = result.spacing[n - 1];
  // Normals of the poles from differences across them.
  constexpr double kNear = 1e-4;
  constexpr double kPi = std::numbers::pi;
  const Vector theta{{0.0, kNear, kNear, kNear, kNear, kPi, kPi - kNear, kPi - kNear, kPi - kNear, kPi - kNear}};
  const Vector phi{{0.0, 0.0, kPi, 0.5 * kPi, 1.5 * kPi, 0.0, 0.0, kPi, 0.5 * kPi, 1.5 * kPi}};
  const Eigen::Matrix3Xd x = evaluate_harmonics(position, theta, phi, nodes.azimuthal_order()).transpose();
  for (const Index pole : {0, 1}) {
    const auto around = [&](Index i) { return Vector3(x.col(5 * pole + i)); };
    const Vector3 outward = (around(1) - around(2)).cross(around(3) - around(4)).normalized();
    result.position.col(n + pole) = around(0);
    result.normal.col(n + pole) = pole == 0 ? outward : Vector3(-outward);
  }
  return result;
}

}  // namespace

LayerCheck check_layers(const Membrane& membrane) {
  const SphereTransform& fine = membrane.fine;
  LayerCheck check;
  if (!membrane.layers.stokes_single.empty()) {
    const Matrix density = membrane.surface.area_element.asDiagonal() * membrane.surface.normal;
    const Matrix kept = fine.analyze(density);
    check.error = largest_length(fine.synthesize(membrane.layers.stokes_single.apply(kept))) / membrane.radius;
    // S takes degree n of a weighted density to 1/(2n) of it over the radius.
    const double lost = largest_length(density - fine.synthesize(kept));
    check.truncation = lost / (2.0 * fine.order() * membrane.radius * membrane.radius);
  }
  if (!membrane.layers.laplace_double.empty()) {
    Vector one = Vector::Zero(n_coefficients(fine.order()));
    one[0] = std::sqrt(4.0 * std::numbers::pi);
    const Matrix image = fine.synthesize(membrane.layers.laplace_double.apply(one));
    check.error = std::max(check.error, (image.array() + 0.5).abs().maxCoeff());
  }
  return check;
}

double separation(const SphereTransform& nodes, const Matrix& position, bool one_meridian_suffices) {
  constexpr double kFacing = -0.5;
  const ProbePoints at = probe_points(nodes, position);
  const Index n = at.spacing.size();
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < n; ++i) {
    const bool is_pole = i >= n - 2;
    if (one_meridian_suffices && !is_pole && i % nodes.grid().n_phi != 0) continue;
    for (Index j = one_meridian_suffices ? 0 : i + 1; j < n; ++j) {
      if (at.normal.col(i).dot(at.normal.col(j)) > kFacing) continue;
      const Vector3 direction = (at.normal.col(i) - at.normal.col(j)).normalized();
      const Vector3 offset = at.position.col(j) - at.position.col(i);
      const double along = offset.dot(direction);
      const double wide = std::max(at.spacing[i], at.spacing[j]);
      if (offset.squaredNorm() - along * along > wide * wide) continue;
      least = std::min(least, std::abs(along) / wide);
    }
  }
  return least;
}

void require_apart(double separation, double before) {
  if (separation < thresholds::contact) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane are {:.2g} grid spacings from each other, too near for any quadrature", separation));
  }
  if (separation < std::min(1.0, thresholds::least_approach * before)) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane come within {:.2g} grid spacings of each other in one step", separation));
  }
}

}  // namespace vehd
