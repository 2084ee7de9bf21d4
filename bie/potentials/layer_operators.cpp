#include "bie/potentials/layer_operators.hpp"

#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Matrix entries below which waking a second thread costs more than it saves.
constexpr Index kParallelEntries = 250000;

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

}  // namespace

Matrix ScalarOperator::apply(const Matrix& density) const {
  require_density(density, transposed_.rows(), active_);
  if (!active_.empty()) {
    return scattered(transposed_.transpose() * gathered(density, active_), active_, density.rows());
  }
  Matrix result(transposed_.cols(), density.cols());
  for_each_index(transposed_.cols(), transposed_.size() > kParallelEntries, [&](Index out) {
    for (Index f = 0; f < density.cols(); ++f) result(out, f) = transposed_.col(out).dot(density.col(f));
  });
  return result;
}

Matrix StokesOperator::apply(const Matrix& density) const {
  require_density(density, transposed_[0].rows(), active_);
  require_size("density (Cartesian components)", density.cols(), 3);
  if (!active_.empty()) return scattered(apply_blocks(gathered(density, active_)), active_, density.rows());
  return apply_blocks(density);
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
