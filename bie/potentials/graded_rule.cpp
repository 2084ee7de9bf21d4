#include "bie/potentials/graded_rule.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "bie/sphere/grid.hpp"
#include "bie/sphere/legendre.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Columns at a time, few enough for their sums to stay in cache.
constexpr Index kColumns = 24 * kLanes;

}  // namespace

AzimuthSums::AzimuthSums(int n_phi, int order) : n_phi_(n_phi), order_(order) {
  require_size("azimuths (a multiple of four)", n_phi % 4, 0);
  for (const bool sine : {false, true}) {
    for (const int parity : {0, 1}) {
      Family& family = families_[static_cast<std::size_t>(2 * sine + parity)];
      const int lowest = sine && parity == 0 ? 2 : parity;
      family.first = sine ? order + lowest : lowest;
      family.count = std::max(0, (order - lowest + 2) / 2);
      family.table.resize(n_phi / 4, family.count);
      for (Index k = 0; k < family.table.rows(); ++k) {
        const double psi = (static_cast<double>(k) + 0.5) * 2.0 * std::numbers::pi / n_phi;
        for (Index i = 0; i < family.count; ++i) {
          const double m = lowest + 2.0 * static_cast<double>(i);
          family.table(k, i) = sine ? std::sin(m * psi) : std::cos(m * psi);
        }
      }
    }
  }
}

RowMatrix AzimuthSums::values(const RowMatrix& amplitudes) const {
  require_size("amplitudes", amplitudes.rows(), n_modes());
  const Index width = amplitudes.cols(), quarter = n_phi_ / 4;
  RowMatrix result(n_phi_, width);
  std::vector<double> sums(static_cast<std::size_t>(4 * quarter * kColumns));
  for (Index first = 0; first < width; first += kColumns) {
    const Index columns = std::min(kColumns, width - first);
    const auto sum = [&](Index family, Index k) { return sums.data() + (family * quarter + k) * columns; };
    for (Index f = 0; f < 4; ++f) {
      const Family& family = families_[static_cast<std::size_t>(f)];
      small_product(quarter, family.count, columns, {family.table.data(), family.count, 1},
                    amplitudes.data() + family.first * width + first, 2 * width, sum(f, 0), columns);
    }
    for (Index k = 0; k < quarter; ++k) {
      const double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
      const auto at = [&](Index azimuth) { return result.data() + azimuth * width + first; };
      double *here = at(k), *across = at(2 * quarter - 1 - k), *opposite = at(2 * quarter + k),
             *below = at(n_phi_ - 1 - k);
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        const double even = ce[c] + co[c], even_image = ce[c] - co[c];
        const double odd = so[c] + se[c], odd_image = so[c] - se[c];
        here[c] = even + odd;
        below[c] = even - odd;
        across[c] = even_image + odd_image;
        opposite[c] = even_image - odd_image;
      }
    }
  }
  return result;
}

RowMatrix AzimuthSums::adjoint(const RowMatrix& values) const {
  require_size("values", values.rows(), n_phi_);
  const Index width = values.cols(), quarter = n_phi_ / 4;
  RowMatrix result(n_modes(), width);
  std::vector<double> sums(static_cast<std::size_t>(4 * quarter * kColumns));
  for (Index first = 0; first < width; first += kColumns) {
    const Index columns = std::min(kColumns, width - first);
    const auto sum = [&](Index family, Index k) { return sums.data() + (family * quarter + k) * columns; };
    for (Index k = 0; k < quarter; ++k) {
      const auto at = [&](Index azimuth) { return values.data() + azimuth * width + first; };
      const double *here = at(k), *across = at(2 * quarter - 1 - k), *opposite = at(2 * quarter + k),
                   *below = at(n_phi_ - 1 - k);
      double *ce = sum(0, k), *co = sum(1, k), *se = sum(2, k), *so = sum(3, k);
#pragma omp simd
      for (Index c = 0; c < columns; ++c) {
        const double even = here[c] + below[c], even_image = across[c] + opposite[c];
        const double odd = here[c] - below[c], odd_image = across[c] - opposite[c];
        ce[c] = even + even_image;
        co[c] = even - even_image;
        so[c] = odd + odd_image;
        se[c] = odd - odd_image;
      }
    }
    for (Index f = 0; f < 4; ++f) {
      const Family& family = families_[static_cast<std::size_t>(f)];
      small_product(family.count, quarter, columns, {family.table.data(), 1, family.count}, sum(f, 0), columns,
                    result.data() + family.first * width + first, 2 * width);
    }
  }
  return result;
}

namespace {

/// Slope of s(t) per degree, for nodes away from the pole; half and twice this need more nodes for equal accuracy.
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

/// P_n(cos t) − 1 for n = 0..order by a recurrence of the difference itself, without cancellation.
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
