#include "bie/potentials/solid_harmonics.hpp"

#include <algorithm>
#include <cstring>
#include <vector>

#include "bie/support/lanes.hpp"

namespace vehd {

namespace {

Index real_part(int l, int m) { return Index{l} * l + (m == 0 ? 0 : 2 * m - 1); }
Index imaginary_part(int l, int m) { return Index{l} * l + 2 * m; }

}  // namespace

Matrix regular_harmonics(const Matrix& points, int degree) {
  Matrix result = Matrix::Zero(points.rows(), n_solid(degree));
  const Eigen::ArrayXd x = points.col(0), y = points.col(1), z = points.col(2);
  const Eigen::ArrayXd r2 = x.square() + y.square() + z.square();
  // One order at a time: degrees upwards from R_mm.
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

namespace {

constexpr int kDoubleDegree = 9;
/// Nodes processed side by side.
constexpr Index kNodesTogether = 4;
/// Columns of R and of q whose sums stay in registers.
constexpr Index kHarmonics = 2, kDensities = 4;

using FourDoubles = Lanes<kNodesTogether>::Values;

FourDoubles four(const double* at) { return Lanes<kNodesTogether>::load(at); }
FourDoubles four(const float* at) {
  using FourFloats [[gnu::vector_size(kNodesTogether * sizeof(float))]] = float;
  FourFloats values;
  std::memcpy(&values, at, sizeof values);
  return __builtin_convertvector(values, FourDoubles);
}

template <class Entry>
using EntryColumns = Eigen::Matrix<Entry, Eigen::Dynamic, Eigen::Dynamic>;

/// Products of kR columns of R and kQ columns of q from given ones on.
template <Index kR, Index kQ, class Entry>
void moment_block(const EntryColumns<Entry>& r, Index first_r, const Matrix& q, Index first_q, Matrix& result) {
  const Index n = r.rows();
  const Entry* of_r = r.col(first_r).data();
  const double* of_q = q.col(first_q).data();
  FourDoubles sum[kR][kQ] = {};
  for (Index i = 0; i < n; i += kNodesTogether) {
    FourDoubles piece[kR];
#pragma GCC unroll 4
    for (Index a = 0; a < kR; ++a) piece[a] = four(of_r + a * n + i);
#pragma GCC unroll 4
    for (Index b = 0; b < kQ; ++b) {
      const FourDoubles density = four(of_q + b * n + i);
#pragma GCC unroll 4
      for (Index a = 0; a < kR; ++a) sum[a][b] += piece[a] * density;
    }
  }
  for (Index a = 0; a < kR; ++a) {
    for (Index b = 0; b < kQ; ++b) {
      const FourDoubles& s = sum[a][b];
      result(first_r + a, first_q + b) = (s[0] + s[1]) + (s[2] + s[3]);
    }
  }
}

template <Index kQ, class Entry>
void moment_panel(const EntryColumns<Entry>& r, const Matrix& q, Index first_q, Matrix& result) {
  Index a = 0;
  for (; a + kHarmonics <= r.cols(); a += kHarmonics) moment_block<kHarmonics, kQ>(r, a, q, first_q, result);
  for (; a < r.cols(); ++a) moment_block<1, kQ>(r, a, q, first_q, result);
}

/// Rᵀ q.
template <class Entry>
Matrix moment_products(const EntryColumns<Entry>& r, const Matrix& q) {
  Matrix result(r.cols(), q.cols());
  Index b = 0;
  for (; b + kDensities <= q.cols(); b += kDensities) moment_panel<kDensities>(r, q, b, result);
  for (; b < q.cols(); ++b) moment_panel<1>(r, q, b, result);
  return result;
}

}  // namespace

MomentSums::MomentSums(const Matrix& regular) : n_nodes_(regular.rows()) {
  const Index n = (n_nodes_ + kNodesTogether - 1) / kNodesTogether * kNodesTogether;
  const Index n_low = std::min(n_solid(kDoubleDegree), regular.cols()), n_high = regular.cols() - n_low;
  low_ = Matrix::Zero(n, n_low);
  low_.topRows(n_nodes_) = regular.leftCols(n_low);
  high_ = Eigen::MatrixXf::Zero(n, n_high);
  scale_ = Vector::Ones(n_high);
  for (Index i = 0; i < n_high; ++i) {
    const double largest = regular.col(n_low + i).cwiseAbs().maxCoeff();
    if (largest == 0.0) continue;
    scale_[i] = largest;
    high_.col(i).head(n_nodes_) = (regular.col(n_low + i) / largest).cast<float>();
  }
}

Matrix MomentSums::of(const Matrix& densities) const {
  Matrix filled = Matrix::Zero(low_.rows(), densities.cols());
  filled.topRows(n_nodes_) = densities;
  Matrix result(low_.cols() + high_.cols(), densities.cols());
  result.topRows(low_.cols()) = moment_products<double>(low_, filled);
  result.bottomRows(high_.cols()) = scale_.asDiagonal() * moment_products<float>(high_, filled);
  return result;
}

}  // namespace vehd
