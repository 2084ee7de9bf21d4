#include "bie/potentials/graded_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/legendre.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Nodes away from the pole against nodes towards it; half and twice this need more nodes for the same accuracy.
constexpr double kSlopePerDegree = 0.25;

/// Root t of asinh(t/scale) + slope t = s. In u = asinh(t/scale) the left side is convex, so that Newton's method from
/// above converges monotonically.
double graded_angle(double scale, double slope, double s) {
  double u = std::min(s, std::asinh(s / (slope * scale)));
  constexpr int kMaxSteps = 100;
  for (int step = 0; step < kMaxSteps; ++step) {
    const double correction = (u + slope * scale * std::sinh(u) - s) / (1.0 + slope * scale * std::cosh(u));
    u -= correction;
    if (std::abs(correction) < 1e-15 * u) break;
  }
  return scale * std::sinh(u);
}

/// P_n(cos t) − 1 for n = 0..order by the recurrence of the difference itself: nothing cancels.
Matrix legendre_minus_one(int order, const Vector& theta) {
  const Eigen::ArrayXd cosine = theta.array().cos();
  const Eigen::ArrayXd cosine_minus_one = -2.0 * (0.5 * theta.array()).sin().square();
  Matrix table = Matrix::Zero(theta.size(), order + 1);
  for (int n = 1; n <= order; ++n) {
    const double two_n_minus_one = 2.0 * n - 1.0;
    table.col(n) = two_n_minus_one / n * (cosine * table.col(n - 1).array() + cosine_minus_one);
    if (n > 1) table.col(n) -= (n - 1.0) / n * table.col(n - 2);
  }
  return table;
}

}  // namespace

GradedRule make_graded_rule(int order, double scale, int n_theta, int n_phi) {
  require_size("colatitudes (a multiple of four)", n_theta % kLanes, 0);
  GradedRule rule;
  rule.n_phi = n_phi;
  rule.theta.resize(n_theta);
  rule.weight.resize(n_theta);
  const GaussLegendre gauss = gauss_legendre(n_theta);
  const double slope = std::max(kSlopePerDegree * order, 1.0);
  const double length = std::asinh(std::numbers::pi / scale) + slope * std::numbers::pi;
  for (int i = 0; i < n_theta; ++i) {
    const double t = graded_angle(scale, slope, 0.5 * length * (gauss.nodes[i] + 1.0));
    const double dt_ds = 1.0 / (1.0 / std::hypot(t, scale) + slope);
    rule.theta[i] = t;
    rule.weight[i] = 0.5 * length * gauss.weights[i] * dt_ds * std::sin(t) * (2.0 * std::numbers::pi / n_phi);
  }

  const LegendreTables legendre = legendre_tables(order, rule.theta);
  const Matrix difference = legendre_minus_one(order, rule.theta);
  for (int m = 0; m <= order; ++m) {
    Matrix stack(3 * n_theta, order + 1 - m);
    stack << legendre.value[m], legendre.d_theta[m], legendre.m_over_sin[m];
    if (m == 0) {
      for (int n = 0; n <= order; ++n) {
        stack.col(n).head(n_theta) = std::sqrt((2.0 * n + 1.0) / (4.0 * std::numbers::pi)) * difference.col(n);
      }
    }
    RowMatrix by_rows = RowMatrix::Zero(3 * n_theta, filled_up(stack.cols()));
    by_rows.leftCols(stack.cols()) = stack;
    rule.adjoint.push_back(std::move(by_rows));
    rule.synthesis.push_back(std::move(stack));
  }

  rule.azimuths = AzimuthSums(n_phi, order);
  return rule;
}

}  // namespace vehd
