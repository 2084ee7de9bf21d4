#include "bie/sphere/maximum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/sphere/point_derivatives.hpp"

namespace vehd {
namespace {

/// Step to the maximum of a parabola, and the gain in value.
struct Climb {
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  double gain = 0.0;
  bool near = true;  ///< the maximum is within reach
};

/// Newton step along the directions in which the field curves downwards. On the ridge of a ring there is only one.
Climb climb(const Eigen::Vector2d& gradient, const Eigen::Matrix2d& hessian, double reach) {
  constexpr double kFlat = 1e-6;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  solver.computeDirect(-hessian);
  const double least = kFlat * solver.eigenvalues().cwiseAbs().maxCoeff();
  Climb result;
  for (Index i = 0; i < 2; ++i) {
    const double curvature = solver.eigenvalues()[i];
    if (curvature <= least) continue;
    const Eigen::Vector2d axis = solver.eigenvectors().col(i);
    const double slope = axis.dot(gradient);
    result.near = result.near && std::abs(slope) <= curvature * reach;
    const double length = std::clamp(slope / curvature, -reach, reach);
    result.step += length * axis;
    result.gain += length * (slope - 0.5 * curvature * length);
  }
  return result;
}

}  // namespace

Top top_of(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
           double sign) {
  // Beyond the node spacing a parabola is not a valid approximation.
  const double reach = std::numbers::pi / static_cast<double>(grid.n_theta);
  const double scale = nodes.value.col(column).cwiseAbs().maxCoeff();
  const int azimuthal_order = azimuthal_order_of(coefficients);
  const auto climb_from = [&](Index node) {
    Eigen::Matrix2d hessian;
    hessian << nodes.d11(node, column), nodes.d12(node, column), nodes.d12(node, column), nodes.d22(node, column);
    return climb(sign * Eigen::Vector2d(nodes.d1(node, column), nodes.d2(node, column)), sign * hessian, reach);
  };
  const auto top_above = [&](Index node) {
    constexpr double kRounding = 1e-15;
    constexpr int kMost = 12;
    double value = sign * nodes.value(node, column);
    SpherePoint at = point_of(grid, node);
    Climb next = climb_from(node);
    for (int count = 0; count < kMost && next.gain > kRounding * scale; ++count) {
      const SpherePoint end = point_of(TangentFrame(at).moved(next.step));
      const PointDerivatives there = point_derivatives(coefficients, end, azimuthal_order);
      if (sign * there.value[0] <= value) {
        next.step *= 0.5;
        next.gain *= 0.5;
        continue;
      }
      value = sign * there.value[0];
      at = end;
      next = climb(sign * there.gradient(0), sign * there.hessian(0), reach);
    }
    return Top{at, value};
  };

  Index largest = 0;
  const double most = (sign * nodes.value.col(column)).maxCoeff(&largest);
  std::vector<std::pair<double, Index>> candidates;
  for (Index node = 0; node < grid.n_points(); ++node) {
    const double value = sign * nodes.value(node, column);
    // Along either axis a parabola gains less than its slope times the reach.
    const double d1 = nodes.d1(node, column), d2 = nodes.d2(node, column);
    const double gain = std::numbers::sqrt2 * std::sqrt(d1 * d1 + d2 * d2) * reach;
    if (node == largest || value + gain < most) continue;
    if (const Climb next = climb_from(node); next.near) candidates.emplace_back(value + next.gain, node);
  }
  std::sort(candidates.begin(), candidates.end(), std::greater<>());
  Top top = top_above(largest);
  std::vector<Vector3> climbed{direction(point_of(grid, largest))};
  for (const auto& [promise, node] : candidates) {
    constexpr std::size_t kHumps = 4;
    constexpr double kApart = 3.0;
    if (climbed.size() == kHumps) break;
    const Vector3 from = direction(point_of(grid, node));
    const bool apart = std::all_of(climbed.begin(), climbed.end(),
                                   [&](const Vector3& other) { return (from - other).norm() > kApart * reach; });
    if (!apart) continue;
    if (const Top other = top_above(node); other.value > top.value) top = other;
    climbed.push_back(from);
  }
  return top;
}

double maximum(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
               double sign) {
  return top_of(grid, nodes, column, coefficients, sign).value;
}

}  // namespace vehd
