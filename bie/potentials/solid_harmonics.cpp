#include "bie/potentials/solid_harmonics.hpp"

#include <vector>

namespace vehd {

namespace {

Index real_part(int l, int m) { return Index{l} * l + (m == 0 ? 0 : 2 * m - 1); }
Index imaginary_part(int l, int m) { return Index{l} * l + 2 * m; }

/// One entry; the imaginary part of order 0 is zero.
struct Complex {
  double re = 0.0, im = 0.0;
};

/// Of any order, by I_{l,−m} = (−1)^m conj(I_lm).
Complex at(const Vector& harmonics, int l, int m) {
  if (m < 0) {
    const Complex z = at(harmonics, l, -m);
    return m % 2 == 0 ? Complex{z.re, -z.im} : Complex{-z.re, z.im};
  }
  return {harmonics[real_part(l, m)], m == 0 ? 0.0 : harmonics[imaginary_part(l, m)]};
}

}  // namespace

Matrix regular_harmonics(const Matrix& points, int degree) {
  Matrix result = Matrix::Zero(points.rows(), n_solid(degree));
  const Eigen::ArrayXd x = points.col(0), y = points.col(1), z = points.col(2);
  const Eigen::ArrayXd r2 = x.square() + y.square() + z.square();
  // Orders one by one: upwards from R_mm.
  Eigen::ArrayXd re = Eigen::ArrayXd::Ones(points.rows()), im = Eigen::ArrayXd::Zero(points.rows());
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) {
      const Eigen::ArrayXd former = re;
      re = -(x * former - y * im) / (2.0 * m);
      im = -(x * im + y * former) / (2.0 * m);
    }
    const auto climb = [&](const Eigen::ArrayXd& lowest, auto index) {
      result.col(index(m, m)) = lowest;
      if (m < degree) result.col(index(m + 1, m)) = z * lowest;
      for (int l = m + 2; l <= degree; ++l) {
        result.col(index(l, m)) =
            ((2.0 * l - 1.0) * z * result.col(index(l - 1, m)).array() - r2 * result.col(index(l - 2, m)).array()) /
            (static_cast<double>(l + m) * (l - m));
      }
    };
    climb(re, real_part);
    if (m > 0) climb(im, imaginary_part);
  }
  return result;
}

Vector irregular_harmonics(const Vector3& point, int degree) {
  Vector result(n_solid(degree));
  const double inverse2 = 1.0 / point.squaredNorm();
  double re = std::sqrt(inverse2), im = 0.0;
  for (int m = 0; m <= degree; ++m) {
    if (m > 0) {
      const double former = re, factor = -(2.0 * m - 1.0) * inverse2;
      re = factor * (point.x() * former - point.y() * im);
      im = factor * (point.x() * im + point.y() * former);
    }
    const auto climb = [&](double lowest, auto index) {
      double before = 0.0, last = lowest;
      result[index(m, m)] = lowest;
      for (int l = m + 1; l <= degree; ++l) {
        const double next =
            ((2.0 * l - 1.0) * point.z() * last - (static_cast<double>(l - 1) * (l - 1) - m * m) * before) * inverse2;
        before = last;
        last = next;
        result[index(l, m)] = next;
      }
    };
    climb(re, real_part);
    if (m > 0) climb(im, imaginary_part);
  }
  return result;
}

Eigen::SparseMatrix<double> regular_derivative(int axis, int degree) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Index row, Index column, double value) { entries.emplace_back(row, column, value); };
  for (int l = 1; l <= degree; ++l) {
    for (int m = 0; m <= l; ++m) {
      const Index re = real_part(l, m), im = imaginary_part(l, m);
      const bool has_above = m + 1 <= l - 1, has_same = m <= l - 1;
      if (axis == 2) {
        if (has_same) add(real_part(l - 1, m), re, 1.0);
        if (has_same && m > 0) add(imaginary_part(l - 1, m), im, 1.0);
      } else if (m == 0) {
        if (has_above) add(axis == 0 ? real_part(l - 1, 1) : imaginary_part(l - 1, 1), re, 1.0);
      } else {
        // ∂x = ½(R_{m+1} − R_{m−1}), ∂y = −½i (R_{m+1} + R_{m−1}) of degree l − 1.
        const auto add_order = [&](int order, double sign) {
          const Index from_re = real_part(l - 1, order), from_im = imaginary_part(l - 1, order);
          if (axis == 0) {
            add(from_re, re, 0.5 * sign);
            if (order > 0) add(from_im, im, 0.5 * sign);
          } else {
            if (order > 0) add(from_im, re, 0.5);
            add(from_re, im, -0.5);
          }
        };
        if (has_above) add_order(m + 1, 1.0);
        add_order(m - 1, -1.0);
      }
    }
  }
  Eigen::SparseMatrix<double> result(n_solid(degree), n_solid(degree));
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

Matrix moments_to_local(const Vector3& offset, int degree) {
  const Vector harmonics = irregular_harmonics(offset, 2 * degree);
  Matrix result(n_solid(degree), n_solid(degree));
  for (int l = 0; l <= degree; ++l) {
    for (int k = 0; k <= l; ++k) {
      for (int n = 0; n <= degree; ++n) {
        const double sign = n % 2 == 0 ? 1.0 : -1.0;
        for (int m = 0; m <= n; ++m) {
          // Orders m of R and −m are conjugates: φ = Re of the sum with twice the weight.
          const double weight = m == 0 ? sign : 2.0 * sign;
          const Complex plus = at(harmonics, l + n, m + k), minus = at(harmonics, l + n, m - k);
          const double parity = k % 2 == 0 ? 1.0 : -1.0;
          // M_lk I_{m+k} + M_{l,−k} I_{m−k} of M_lk = 1 and of M_lk = i.
          const Complex of_real = k == 0 ? plus : Complex{plus.re + parity * minus.re, plus.im + parity * minus.im};
          const Complex of_imaginary{-plus.im + parity * minus.im, plus.re - parity * minus.re};
          result(real_part(n, m), real_part(l, k)) = weight * of_real.re;
          if (m > 0) result(imaginary_part(n, m), real_part(l, k)) = weight * of_real.im;
          if (k > 0) result(real_part(n, m), imaginary_part(l, k)) = weight * of_imaginary.re;
          if (m > 0 && k > 0) result(imaginary_part(n, m), imaginary_part(l, k)) = weight * of_imaginary.im;
        }
      }
    }
  }
  return result;
}

Matrix moments(const Matrix& regular_sums) {
  Matrix result = regular_sums;
  for (int l = 1; n_solid(l) <= result.rows(); ++l) {
    for (int m = 1; m <= l; ++m) result.row(imaginary_part(l, m)) *= -1.0;
  }
  return result;
}

}  // namespace vehd
