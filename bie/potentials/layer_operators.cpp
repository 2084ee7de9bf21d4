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
  const Index n_in = transposed_[0].rows();
  Matrix result(transposed_[0].cols(), 3);
  const double* x = density.col(0).data();
  const double* y = density.col(1).data();
  const double* z = density.col(2).data();
  for_each_index(transposed_[0].cols(), 6 * transposed_[0].size() > kParallelEntries, [&](Index out) {
    const auto block = [&](std::size_t i) { return transposed_[i].col(out).data(); };
    const double *xx = block(0), *xy = block(1), *xz = block(2), *yy = block(3), *yz = block(4), *zz = block(5);
    // Nine sums hide the latency of one another, and every entry is read once.
    double xx_x = 0.0, xy_y = 0.0, xz_z = 0.0, xy_x = 0.0, yy_y = 0.0, yz_z = 0.0, xz_x = 0.0, yz_y = 0.0, zz_z = 0.0;
#pragma omp simd reduction(+ : xx_x, xy_y, xz_z, xy_x, yy_y, yz_z, xz_x, yz_y, zz_z)
    for (Index i = 0; i < n_in; ++i) {
      xx_x += xx[i] * x[i];
      xy_y += xy[i] * y[i];
      xz_z += xz[i] * z[i];
      xy_x += xy[i] * x[i];
      yy_y += yy[i] * y[i];
      yz_z += yz[i] * z[i];
      xz_x += xz[i] * x[i];
      yz_y += yz[i] * y[i];
      zz_z += zz[i] * z[i];
    }
    result(out, 0) = xx_x + xy_y + xz_z;
    result(out, 1) = xy_x + yy_y + yz_z;
    result(out, 2) = xz_x + yz_y + zz_z;
  });
  return result;
}

}  // namespace vehd
