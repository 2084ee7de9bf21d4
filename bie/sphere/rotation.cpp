#include "bie/sphere/rotation.hpp"

#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

namespace {

double parity(int m) { return m % 2 == 0 ? 1.0 : -1.0; }

/// d^n_{n,k}(β) in Wigner's convention, with c = cos β/2, s = sin β/2.
double highest_row(int n, int k, double c, double s) {
  double value = 1.0;
  // √binomial(2n, n−k) multiplied in step with the powers: neither factor overflows alone.
  const int down = n - k;
  const int up = n + k;
  for (int i = 1; i <= down; ++i) value *= -s * std::sqrt(double(2 * n - down + i) / i);
  for (int i = 0; i < up; ++i) value *= c;
  return value;
}

/// First entry of the sequence in n: n = max(|m|, |k|).
double start_value(int m, int k, double c, double s) {
  const int n = std::max(std::abs(m), std::abs(k));
  if (m == n) return highest_row(n, k, c, s);
  if (m == -n) return parity(n + k) * highest_row(n, -k, c, s);
  if (k == n) return parity(n - m) * highest_row(n, m, c, s);
  return highest_row(n, -m, c, s);  // k = -n: d_{m,-n} = d_{n,-m}
}

/// An angle β by what the sequences of all m and k take of it.
struct Angle {
  double cosine, half_cosine, half_sine;

  explicit Angle(double beta)
      : cosine(std::cos(beta)), half_cosine(std::cos(beta / 2)), half_sine(std::sin(beta / 2)) {}
};

/// d^n_{m,k}(β) for n = 0..order, zero below max(|m|, |k|).
Vector wigner_sequence(int order, int m, int k, const Angle& beta) {
  Vector d = Vector::Zero(order + 1);
  const int first = std::max(std::abs(m), std::abs(k));
  d[first] = start_value(m, k, beta.half_cosine, beta.half_sine);
  const double x = beta.cosine;
  const double mm = double(m) * m;
  const double kk = double(k) * k;
  double root_below = 1.0;  // √((n² − m²)(n² − k²)), for the next n
  for (int n = first; n < order; ++n) {
    if (n == 0) {
      d[1] = x;
      continue;
    }
    const double nn = n;
    const double below = n > first ? (nn + 1) * root_below * d[n - 1] : 0.0;
    const double root = std::sqrt(((nn + 1) * (nn + 1) - mm) * ((nn + 1) * (nn + 1) - kk));
    d[n + 1] = ((2 * nn + 1) * (nn * (nn + 1) * x - double(m) * k) * d[n] - below) / (nn * root);
    root_below = root;
  }
  return d;
}

}  // namespace

RotationY rotation_y(int order, double beta) {
  const Angle angle(beta);
  RotationY rotation;
  for (int n = 0; n <= order; ++n) {
    rotation.cosine.emplace_back(Matrix::Zero(n + 1, n + 1));
    rotation.sine.emplace_back(Matrix::Zero(n, n));
  }
  for (int before = 0; before <= order; ++before) {
    for (int after = 0; after <= order; ++after) {
      const Vector plus = wigner_sequence(order, before, after, angle);
      const Vector minus = wigner_sequence(order, -before, after, angle);
      const double sign_after = parity(after);
      const double sign_before = parity(before);
      for (int n = std::max(before, after); n <= order; ++n) {
        double& cosine = rotation.cosine[n](after, before);
        if (before == 0 && after == 0) {
          cosine = plus[n];
        } else if (before == 0) {
          cosine = std::numbers::sqrt2 * sign_after * plus[n];
        } else if (after == 0) {
          cosine = std::numbers::sqrt2 * sign_before * plus[n];
        } else {
          cosine = sign_after * (sign_before * plus[n] + minus[n]);
          rotation.sine[n](after - 1, before - 1) = sign_after * (sign_before * plus[n] - minus[n]);
        }
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
