#include "bie/potentials/solid_harmonics.hpp"

#include <vector>

namespace vehd {

namespace {

Index real_part(int l, int m) { return Index{l} * l + (m == 0 ? 0 : 2 * m - 1); }
Index imaginary_part(int l, int m) { return Index{l} * l + 2 * m; }

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

Matrix moments(const Matrix& regular_sums) {
  Matrix result = regular_sums;
  for (int l = 1; n_solid(l) <= result.rows(); ++l) {
    for (int m = 1; m <= l; ++m) result.row(imaginary_part(l, m)) *= -1.0;
  }
  return result;
}

}  // namespace vehd
