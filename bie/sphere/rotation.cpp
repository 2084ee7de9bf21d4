#include "bie/sphere/rotation.hpp"

#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

namespace {

double parity(int m) { return m % 2 == 0 ? 1.0 : -1.0; }

/// d^n_{m,k}(β) and d^n_{−m,k}(β) in Wigner's convention for n = k..order, 0 ≤ m ≤ k: their recurrences share the
/// roots.
/// @param cosine       cos β
/// @param plus, minus  results; the entries of n = k are given
void wigner_sequences(int order, int m, int k, double cosine, Vector& plus, Vector& minus) {
  const double mm = double(m) * m;
  const double kk = double(k) * k;
  const double mk = double(m) * k;
  double root_below = 1.0;  // √((n² − m²)(n² − k²)), for the next n
  for (int n = k; n < order; ++n) {
    if (n == 0) {
      plus[1] = minus[1] = cosine;
      continue;
    }
    const double nn = n;
    const double below = n > k ? (nn + 1) * root_below : 0.0;
    const double root = std::sqrt(((nn + 1) * (nn + 1) - mm) * ((nn + 1) * (nn + 1) - kk));
    const double inverse = 1.0 / (nn * root);
    const auto next = [&](const Vector& d, double product) {
      const double before = n > k ? below * d[n - 1] : 0.0;
      return ((2 * nn + 1) * (nn * (nn + 1) * cosine - product) * d[n] - before) * inverse;
    };
    plus[n + 1] = next(plus, mk);
    minus[n + 1] = next(minus, -mk);
    root_below = root;
  }
}

}  // namespace

RotationY rotation_y(int order, double beta) {
  const double half_cosine = std::cos(beta / 2), half_sine = std::sin(beta / 2);
  RotationY rotation;
  for (int n = 0; n <= order; ++n) {
    rotation.cosine.emplace_back(Matrix::Zero(n + 1, n + 1));
    rotation.sine.emplace_back(Matrix::Zero(n, n));
  }
  Vector plus(order + 1), minus(order + 1);
  for (int before = 0; before <= order; ++before) {
    // d^k_{m,k} = √binomial(2k, k−m) cos^{k+m} β/2 sin^{k−m} β/2, with m = ± before and k = after
    double first_plus = std::pow(half_cosine, 2 * before), first_minus = std::pow(half_sine, 2 * before);
    for (int after = before; after <= order; ++after) {
      if (after > before) {
        const double k = after, m = before;
        const double factor = half_cosine * half_sine * std::sqrt(2 * k * (2 * k - 1) / ((k - m) * (k + m)));
        first_plus *= factor;
        first_minus *= factor;
      }
      plus[after] = first_plus;
      minus[after] = first_minus;
      wigner_sequences(order, before, after, std::cos(beta), plus, minus);
      const double sign_after = parity(after);
      const double sign_before = parity(before);
      // d^n_{m,k} = (−1)^{m−k} d^n_{k,m} = d^n_{−k,−m}
      const double sign = sign_before * sign_after;
      for (int n = after; n <= order; ++n) {
        double cosine = plus[n];
        if (before == 0 && after > 0) cosine *= std::numbers::sqrt2 * sign_after;
        if (before > 0) {
          cosine = sign_after * (sign_before * plus[n] + minus[n]);
          const double sine = sign_after * (sign_before * plus[n] - minus[n]);
          rotation.sine[n](after - 1, before - 1) = sine;
          rotation.sine[n](before - 1, after - 1) = sign * sine;
        }
        rotation.cosine[n](after, before) = cosine;
        rotation.cosine[n](before, after) = sign * cosine;
      }
    }
  }
  return rotation;
}

Matrix rotated_fields(const Matrix& coefficients, const Matrix3& rotation) {
  const int order = order_of(coefficients.rows());
  const SphereTransform transform(order, make_grid(order));
  const SphereGrid& grid = transform.grid();
  Vector theta(grid.n_points()), phi(grid.n_points());
  for (Index j = 0; j < grid.n_theta; ++j) {
    for (Index k = 0; k < grid.n_phi; ++k) {
      const SpherePoint before = point_of(Vector3(rotation.transpose() * direction({grid.theta(j), grid.phi(k)})));
      theta(j * grid.n_phi + k) = before.theta;
      phi(j * grid.n_phi + k) = before.phi;
    }
  }
  return transform.analyze(evaluate_harmonics(coefficients, theta, phi));
}

}  // namespace vehd
