#include "bie/potentials/moment_sums.hpp"

#include <algorithm>

#include "bie/potentials/solid_harmonics.hpp"

namespace vehd {

namespace {

constexpr int kDoubleDegree = 9;
/// Nodes that stand side by side.
constexpr Index kNodesTogether = 4;
/// Columns of R and of q whose sums stay in registers.
constexpr Index kHarmonics = 2, kDensities = 4;

using FourDoubles [[gnu::vector_size(kNodesTogether * sizeof(double))]] = double;
using FourDoublesAnywhere
    [[gnu::vector_size(kNodesTogether * sizeof(double)), gnu::aligned(alignof(double)), gnu::may_alias]] = double;
using FourFloatsAnywhere
    [[gnu::vector_size(kNodesTogether * sizeof(float)), gnu::aligned(alignof(float)), gnu::may_alias]] = float;

FourDoubles four(const double* at) { return *reinterpret_cast<const FourDoublesAnywhere*>(at); }
FourDoubles four(const float* at) {
  return __builtin_convertvector(*reinterpret_cast<const FourFloatsAnywhere*>(at), FourDoubles);
}

template <class Entry>
using EntryColumns = Eigen::Matrix<Entry, Eigen::Dynamic, Eigen::Dynamic>;

/// Products of a few columns from there on.
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
