#include "bie/sphere/maximum.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// A step to the top of a parabola, and how much higher that is.
struct Climb {
  Eigen::Vector2d step = Eigen::Vector2d::Zero();
  double gain = 0.0;
  bool near = true;  ///< the top is within reach
};

/// Along the directions in which the field is curved downwards. On the ridge of a ring there is only one.
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

Vector3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

Vector3 direction(const SphereGrid& grid, Index node) {
  return direction(grid.theta[node / grid.n_phi], grid.phi[node % grid.n_phi]);
}

/// Largest |m| with a coefficient that is not zero.
int azimuthal_order_of(const Vector& coefficients) {
  int most = 0;
  for (int n = 1; n <= order_of(coefficients.size()); ++n) {
    for (int m = n; m > most; --m) {
      if (coefficients[coefficient_index(n, m)] != 0.0 || coefficients[coefficient_index(n, -m)] != 0.0) most = m;
    }
  }
  return most;
}

/// The point at the end of a great circle that leaves (θ, φ) along the step.
void walk(double& theta, double& phi, const Eigen::Vector2d& step) {
  const double length = step.norm();
  const Vector3 radial = direction(theta, phi);
  const Vector3 south{std::cos(theta) * std::cos(phi), std::cos(theta) * std::sin(phi), -std::sin(theta)};
  const Vector3 east{-std::sin(phi), std::cos(phi), 0.0};
  const Vector3 end = std::cos(length) * radial + std::sin(length) / length * (step[0] * south + step[1] * east);
  theta = std::atan2(std::hypot(end.x(), end.y()), end.z());
  phi = std::atan2(end.y(), end.x());
}

/// A field with covariant derivatives in the frame (e_θ, e_φ) of one point.
struct PointDerivatives {
  double value = 0.0;
  Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
  Eigen::Matrix2d hessian = Eigen::Matrix2d::Zero();
};

/// By differences along great circles, which know no pole.
PointDerivatives derivatives_at(const Vector& coefficients, double theta, double phi, int azimuthal_order) {
  // Of the field: truncation 1e-8, rounding of the second differences the same.
  constexpr double kSpacing = 1e-4;
  constexpr int kPoints = 9;
  Vector thetas = Vector::Constant(kPoints, theta), phis = Vector::Constant(kPoints, phi);
  for (int point = 0; point < kPoints; ++point) {
    if (const Eigen::Vector2d offset(point / 3 - 1, point % 3 - 1); !offset.isZero()) {
      walk(thetas[point], phis[point], kSpacing * offset);
    }
  }
  const Vector values = evaluate_harmonics(coefficients, thetas, phis, azimuthal_order);
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

}  // namespace

double maximum(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
               double sign) {
  // Beyond the distance of two nodes a parabola says nothing.
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
    double theta = grid.theta[node / grid.n_phi], phi = grid.phi[node % grid.n_phi];
    Climb next = climb_from(node);
    for (int count = 0; count < kMost && next.gain > kRounding * scale; ++count) {
      double theta_there = theta, phi_there = phi;
      walk(theta_there, phi_there, next.step);
      const PointDerivatives there = derivatives_at(coefficients, theta_there, phi_there, azimuthal_order);
      if (sign * there.value <= value) {
        next.step *= 0.5;
        next.gain *= 0.5;
        continue;
      }
      value = sign * there.value;
      theta = theta_there;
      phi = phi_there;
      next = climb(sign * there.gradient, sign * there.hessian, reach);
    }
    return value;
  };

  Index largest = 0;
  const double most = (sign * nodes.value.col(column)).maxCoeff(&largest);
  // Nodes that are lower by less than a parabola gains in their cell may lead higher.
  const double curvature = std::max({std::abs(nodes.d11(largest, column)), std::abs(nodes.d12(largest, column)),
                                     std::abs(nodes.d22(largest, column))});
  std::vector<std::pair<double, Index>> promises;
  for (Index node = 0; node < grid.n_points(); ++node) {
    const double value = sign * nodes.value(node, column);
    if (node == largest || value < most - curvature * reach * reach) continue;
    if (const Climb next = climb_from(node); next.near) promises.emplace_back(value + next.gain, node);
  }
  std::sort(promises.begin(), promises.end(), std::greater<>());
  double top = top_above(largest);
  std::vector<Vector3> climbed{direction(grid, largest)};
  for (const auto& [promise, node] : promises) {
    constexpr std::size_t kHumps = 4;
    constexpr double kApart = 3.0;
    if (climbed.size() == kHumps) break;
    const Vector3 from = direction(grid, node);
    const bool apart = std::all_of(climbed.begin(), climbed.end(),
                                   [&](const Vector3& other) { return (from - other).norm() > kApart * reach; });
    if (!apart) continue;
    top = std::max(top, top_above(node));
    climbed.push_back(from);
  }
  return top;
}

}  // namespace vehd
