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
  const Index size = density.rows();
  const double* x = density.col(0).data();
  const double* y = density.col(1).data();
  const double* z = density.col(2).data();
  for_each_index(transposed_[0].cols(), 6 * transposed_[0].size() > kParallelEntries, [&](Index out) {
    const double* xx = transposed_[0].col(out).data();
    const double* xy = transposed_[1].col(out).data();
    const double* xz = transposed_[2].col(out).data();
    const double* yy = transposed_[3].col(out).data();
    const double* yz = transposed_[4].col(out).data();
    const double* zz = transposed_[5].col(out).data();
    double u = 0.0, v = 0.0, w = 0.0;
    // One pass over the blocks, which is what takes the time.
#pragma omp simd reduction(+ : u, v, w)
    for (Index i = 0; i < size; ++i) {
      u += xx[i] * x[i] + xy[i] * y[i] + xz[i] * z[i];
      v += xy[i] * x[i] + yy[i] * y[i] + yz[i] * z[i];
      w += xz[i] * x[i] + yz[i] * y[i] + zz[i] * z[i];
    }
    result.row(out) << u, v, w;
  });
  return result;
}

}  // namespace vehd
