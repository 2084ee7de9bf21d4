#include "bie/linear/recycled_subspace.hpp"

#include <algorithm>
#include <cmath>

#include "bie/linear/thresholds.hpp"

namespace vehd {

RecycledSubspace joined(const RecycledSubspace& newer, const RecycledSubspace& older, Index most) {
  if (newer.count() == 0) return older;
  const Index n_newer = std::min(newer.count(), most);
  const Index n_older = std::min(older.count(), most - n_newer);
  const Index size = newer.arguments.rows();
  RecycledSubspace result{Matrix(size, n_newer + n_older), Matrix(size, n_newer + n_older)};
  const auto join = [&](const Matrix& first, const Matrix& second, Matrix& both) {
    both.leftCols(n_newer) = first.leftCols(n_newer);
    if (n_older > 0) both.rightCols(n_older) = second.leftCols(n_older);
  };
  join(newer.arguments, older.arguments, result.arguments);
  join(newer.responses, older.responses, result.responses);
  return result;
}

RecycledSubspace selected(const RecycledSubspace& known, const std::vector<Index>& columns) {
  return {known.arguments(Eigen::all, columns), known.responses(Eigen::all, columns)};
}

SecantInverse::SecantInverse(const RecycledSubspace& known) {
  Matrix gram = Matrix::Zero(known.count(), known.count());
  gram.selfadjointView<Eigen::Lower>().rankUpdate(known.responses.transpose());
  // Cholesky factorisation: each column that is independent of those before it adds a row.
  constexpr double least = thresholds::least_independence;
  factor_ = Matrix::Zero(known.count(), known.count());
  std::vector<double> scale;
  for (Index j = 0; j < known.count() && kept_.size() < thresholds::most_secant_columns; ++j) {
    const double norm = std::sqrt(gram(j, j));
    if (!(norm > 0.0) || !std::isfinite(norm)) continue;
    const auto n = static_cast<Index>(kept_.size());
    Vector row(n);
    for (Index i = 0; i < n; ++i) row[i] = gram(j, kept_[i]) * scale[i] / norm;
    factor_.topLeftCorner(n, n).triangularView<Eigen::Lower>().solveInPlace(row);
    const double remainder = 1.0 - row.squaredNorm();
    if (!(remainder > least * least)) continue;
    factor_.row(n).head(n) = row.transpose();
    factor_(n, n) = std::sqrt(remainder);
    kept_.push_back(j);
    scale.push_back(1.0 / norm);
  }
  const auto n = static_cast<Index>(kept_.size());
  factor_.conservativeResize(n, n);
  const Vector scales = Vector::Map(scale.data(), n);
  responses_ = known.responses(Eigen::all, kept_) * scales.asDiagonal();
  difference_ = known.arguments(Eigen::all, kept_) * scales.asDiagonal() - responses_;
}

Vector SecantInverse::apply(const Vector& r) const {
  if (kept_.empty()) return r;
  Vector shares = responses_.transpose() * r;
  factor_.triangularView<Eigen::Lower>().solveInPlace(shares);
  factor_.transpose().triangularView<Eigen::Upper>().solveInPlace(shares);
  return r + difference_ * shares;
}

}  // namespace vehd
