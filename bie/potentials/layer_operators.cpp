#include "bie/potentials/layer_operators.hpp"

#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Matrix entries below which waking a second thread costs more than it saves.
constexpr Index kParallelEntries = 250000;

}  // namespace

Matrix ScalarOperator::apply(const Matrix& density) const {
  require_size("density", density.rows(), transposed_.rows());
  Matrix result(transposed_.cols(), density.cols());
#pragma omp parallel for schedule(static) if (transposed_.size() > kParallelEntries)
  for (Index out = 0; out < transposed_.cols(); ++out) {
    for (Index f = 0; f < density.cols(); ++f) result(out, f) = transposed_.col(out).dot(density.col(f));
  }
  return result;
}

Matrix StokesOperator::apply(const Matrix& density) const {
  require_size("density", density.rows(), transposed_[0].rows());
  require_size("density (Cartesian components)", density.cols(), 3);
  Matrix result(transposed_[0].cols(), 3);
  const auto x = density.col(0);
  const auto y = density.col(1);
  const auto z = density.col(2);
#pragma omp parallel for schedule(static) if (6 * transposed_[0].size() > kParallelEntries)
  for (Index out = 0; out < transposed_[0].cols(); ++out) {
    const auto xx = transposed_[0].col(out);
    const auto xy = transposed_[1].col(out);
    const auto xz = transposed_[2].col(out);
    const auto yy = transposed_[3].col(out);
    const auto yz = transposed_[4].col(out);
    const auto zz = transposed_[5].col(out);
    result(out, 0) = xx.dot(x) + xy.dot(y) + xz.dot(z);
    result(out, 1) = xy.dot(x) + yy.dot(y) + yz.dot(z);
    result(out, 2) = xz.dot(x) + yz.dot(y) + zz.dot(z);
  }
  return result;
}

}  // namespace vehd
