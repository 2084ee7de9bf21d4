#include "bie/potentials/layer_operators.hpp"

#include <algorithm>

#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Matrix entries below which waking a second thread costs more than it saves.
constexpr Index kParallelEntries = 250000;
/// More than the Cartesian components that a solve applies an operator to.
constexpr Index kFewDensities = 9;

void require_density(const Matrix& density, Index size, const std::vector<Index>& active) {
  if (active.empty()) {
    require_size("density", density.rows(), size);
  } else if (density.rows() <= active.back()) {
    throw ShapeError("density has " + std::to_string(density.rows()) + " coefficients, too few for the operator");
  }
}

Matrix gathered(const Matrix& density, const std::vector<Index>& active) { return density(active, Eigen::all); }

Matrix scattered(const Matrix& values, const std::vector<Index>& active, Index size) {
  Matrix result = Matrix::Zero(size, values.cols());
  result(active, Eigen::all) = values;
  return result;
}

/// transposedᵗ · density, every entry by one thread.
Matrix product(const Matrix& transposed, const Matrix& density) {
  // Read once for each density, a matrix costs as much as the sums while they are few. Of many, a blocked product.
  if (density.cols() > kFewDensities) return transposed.transpose() * density;
  Matrix result(transposed.cols(), density.cols());
  for_each_index(transposed.cols(), transposed.size() > kParallelEntries, [&](Index out) {
    for (Index f = 0; f < density.cols(); ++f) result(out, f) = transposed.col(out).dot(density.col(f));
  });
  return result;
}

}  // namespace

Matrix ScalarOperator::apply(const Matrix& density) const {
  require_size("density", density.rows(), n_coefficients_);
  if (parts_.size() == 1 && parts_[0].transposed.rows() == n_coefficients_) {
    return product(parts_[0].transposed, density);
  }
  Matrix result = Matrix::Zero(density.rows(), density.cols());
  for (const Part& part : parts_) {
    result(part.indices, Eigen::all) = product(part.transposed, gathered(density, part.indices));
  }
  return result;
}

Matrix StokesOperator::apply(const Matrix& density) const {
  require_size("density (Cartesian components)", density.cols(), 3);
  if (!entries_.empty()) {
    require_size("density", density.rows(), n_coefficients_);
    Matrix result = Matrix::Zero(density.rows(), 3);
    result.reshaped()(entries_) = product(on_entries_, density.reshaped()(entries_)).col(0);
    return result;
  }
  require_density(density, transposed_[0].rows(), active_);
  if (!active_.empty()) return scattered(apply_blocks(gathered(density, active_)), active_, density.rows());
  return apply_blocks(density);
}

double StokesOperator::multiplications() const {
  return static_cast<double>(entries_.empty() ? 9 * transposed_[0].size() : on_entries_.size());
}

Matrix StokesOperator::between(Index n_coefficients, const std::vector<Index>& entries) const {
  constexpr int kBlock[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  const std::vector<Index>& known = entries_.empty() ? active_ : entries_;
  // Where the matrices have each entry, −1: nowhere.
  std::vector<Index> place;
  for (const Index entry : entries) {
    const Index wanted = entries_.empty() ? entry % n_coefficients : entry;
    const auto found = std::lower_bound(known.begin(), known.end(), wanted);
    const bool has = found != known.end() && *found == wanted;
    place.push_back(known.empty() ? wanted : has ? found - known.begin() : -1);
  }
  const auto n = static_cast<Index>(entries.size());
  Matrix result = Matrix::Zero(n, n);
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (place[i] < 0 || place[j] < 0) continue;
      const Matrix& from = entries_.empty()
                               ? transposed_[kBlock[entries[i] / n_coefficients][entries[j] / n_coefficients]]
                               : on_entries_;
      result(i, j) = from(place[j], place[i]);
    }
  }
  return result;
}

Matrix StokesOperator::apply_blocks(const Matrix& density) const {
  Matrix result(transposed_[0].cols(), 3);
  const auto x = density.col(0);
  const auto y = density.col(1);
  const auto z = density.col(2);
  for_each_index(transposed_[0].cols(), 6 * transposed_[0].size() > kParallelEntries, [&](Index out) {
    const auto xx = transposed_[0].col(out);
    const auto xy = transposed_[1].col(out);
    const auto xz = transposed_[2].col(out);
    const auto yy = transposed_[3].col(out);
    const auto yz = transposed_[4].col(out);
    const auto zz = transposed_[5].col(out);
    result(out, 0) = xx.dot(x) + xy.dot(y) + xz.dot(z);
    result(out, 1) = xy.dot(x) + yy.dot(y) + yz.dot(z);
    result(out, 2) = xz.dot(x) + yz.dot(y) + zz.dot(z);
  });
  return result;
}

}  // namespace vehd
