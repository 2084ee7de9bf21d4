#include "bie/potentials/foot_point.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/point_derivatives.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// ½|x − y|² on the sphere with its first two derivatives.
struct SquaredDistance {
  double value;
  Eigen::Vector2d gradient;
  Eigen::Matrix2d hessian, metric;
};

SquaredDistance squared_distance(const PointDerivatives& y, const Vector3& target) {
  const Eigen::RowVector3d r = target.transpose() - y.value;
  SquaredDistance q;
  q.value = 0.5 * r.squaredNorm();
  q.gradient << -r.dot(y.d1), -r.dot(y.d2);
  q.metric << y.d1.squaredNorm(), y.d1.dot(y.d2), y.d1.dot(y.d2), y.d2.squaredNorm();
  q.hessian << r.dot(y.d11), r.dot(y.d12), r.dot(y.d12), r.dot(y.d22);
  q.hessian = (q.metric - q.hessian).eval();
  return q;
}

/// Newton's step, or that of Gauss and Newton where the squared distance is not convex.
Eigen::Vector2d descent_step(const SquaredDistance& q) {
  constexpr double kLongestStep = 0.3;
  const bool convex = q.hessian.trace() > 0.0 && q.hessian.determinant() > 1e-6 * q.metric.determinant();
  Eigen::Vector2d step = -(convex ? q.hessian : q.metric).inverse() * q.gradient;
  const double length = step.norm();
  if (length > kLongestStep) step *= kLongestStep / length;
  return step;
}

FootPoint foot_point_at(const TangentFrame& direction, const PointDerivatives& y, const SquaredDistance& q,
                        const Vector3& target) {
  FootPoint foot;
  foot.theta = direction.point.theta;
  foot.phi = direction.point.phi;
  foot.position = y.value.transpose();
  const Vector3 cross = Vector3(y.d1.transpose()).cross(Vector3(y.d2.transpose()));
  foot.area_element = cross.norm();
  foot.normal = cross / foot.area_element;
  foot.height = (target - foot.position).dot(foot.normal);
  // Eigenvalues of the Hessian: their mean and half their difference.
  const double mean = 0.5 * q.hessian.trace();
  const double half = std::hypot(0.5 * (q.hessian(0, 0) - q.hessian(1, 1)), q.hessian(0, 1));
  foot.smallest_stretch = std::sqrt(std::max(mean - half, 0.0));
  foot.largest_stretch = std::sqrt(std::max(mean + half, 0.0));
  return foot;
}

}  // namespace

FootPoint find_foot_point(const Matrix& position, const Vector3& start, const Vector3& target) {
  constexpr int kMaxSteps = 60;
  constexpr int kMaxHalvings = 30;
  constexpr double kTolerance = 1e-13;
  require_size("position (Cartesian components)", position.cols(), 3);
  TangentFrame direction(point_of(start));
  PointDerivatives y = point_derivatives(position, direction.point);
  SquaredDistance q = squared_distance(y, target);
  for (int steps = 0; steps < kMaxSteps; ++steps) {
    Eigen::Vector2d step = descent_step(q);
    const bool last = step.norm() < kTolerance;
    for (int halvings = 0;; ++halvings) {
      const TangentFrame next(point_of(direction.moved(step)));
      const PointDerivatives y_next = point_derivatives(position, next.point);
      const SquaredDistance q_next = squared_distance(y_next, target);
      // The square of a tiny distance is flat to rounding: the gradient decides when the value cannot.
      const bool nearer = q_next.value <= q.value || q_next.gradient.norm() < q.gradient.norm();
      if (nearer || halvings == kMaxHalvings || last) {
        direction = next;
        y = y_next;
        q = q_next;
        break;
      }
      step *= 0.5;
    }
    if (last) return foot_point_at(direction, y, q, target);
  }
  // Near a centre of curvature the distance hardly depends on the point, and any point close to nearest serves.
  constexpr double kFlatGradient = 1e-3;
  if (q.gradient.norm() <= kFlatGradient * std::sqrt(2.0 * q.value * q.metric.trace())) {
    return foot_point_at(direction, y, q, target);
  }
  throw ConvergenceError(
      fmt::format("nearest point of the membrane to ({:.6g}, {:.6g}, {:.6g}): no convergence in {} "
                  "steps from the nearest node",
                  target.x(), target.y(), target.z(), kMaxSteps));
}

}  // namespace vehd
