#include "bie/potentials/layer_operators.hpp"

#include <algorithm>
#include <cmath>

#include "bie/kernels/stokes.hpp"
#include "bie/potentials/few_nodes.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Entries below which waking a second thread costs more than it saves.
constexpr Index kFewSymmetricEntries = 250000;
/// Number of parts of equal work into which columns are split, each with its own sums, for any number of threads.
constexpr Index kParts = 8;

}  // namespace

SymmetricBlocks::SymmetricBlocks(std::vector<int> degrees) : degrees_(std::move(degrees)) {
  Index total = 0;
  for (const int degree : degrees_) {
    ends_.push_back(std::upper_bound(degrees_.begin(), degrees_.end(), degree) - degrees_.begin());
    starts_.push_back(total);
    total += filled(ends_.back());
  }
  values_.resize(total);
}

void SymmetricBlocks::symmetrize() {
  for (Index out = 0; out < size(); ++out) {
    for (int block = 0; block < kBlocks; ++block) {
      // Entries of the diagonal are applied twice, as row and as column.
      column(out)[place(block, out)] *= 0.5;
      for (Index in = out + 1; in < n_in(out); ++in) {
        double& above = column(out)[place(block, in)];
        double& below = column(in)[place(block, out)];
        below = 0.5 * (above + below);
        above = 0.0;
      }
      for (Index in = n_in(out); in % kGroup != 0; ++in) column(out)[place(block, in)] = 0.0;
    }
  }
}

double SymmetricBlocks::at(int block, Index i, Index j) const {
  const Index out = std::max(i, j), in = std::min(i, j);
  const double value = values_[starts_[static_cast<std::size_t>(out)] + place(block, in)];
  return i == j ? 2.0 * value : value;
}

void SymmetricBlocks::apply_columns(Index first, Index end, const RowMatrix& density, RowMatrix& sums) const {
  const double *x = density.row(0).data(), *y = density.row(1).data(), *z = density.row(2).data();
  double *u = sums.row(0).data(), *v = sums.row(1).data(), *w = sums.row(2).data();
  for (Index out = first; out < end; ++out) {
    const double* column = values_.data() + starts_[static_cast<std::size_t>(out)];
    const Few x_out = Few{} + x[out], y_out = Few{} + y[out], z_out = Few{} + z[out];
    Few u_out{}, v_out{}, w_out{};
    for (Index in = 0; in <= out; column += kBlocks * kGroup) {
      for (Index lane = 0; lane < kGroup; lane += kTogether, in += kTogether) {
        const auto block = [&](Index which) { return few(column + which * kGroup + lane); };
        const Few xx = block(0), xy = block(1), xz = block(2), yy = block(3), yz = block(4), zz = block(5);
        const Few x_in = few(x + in), y_in = few(y + in), z_in = few(z + in);
        u_out += xx * x_in + xy * y_in + xz * z_in;
        v_out += xy * x_in + yy * y_in + yz * z_in;
        w_out += xz * x_in + yz * y_in + zz * z_in;
        store(u + in, few(u + in) + xx * x_out + xy * y_out + xz * z_out);
        store(v + in, few(v + in) + xy * x_out + yy * y_out + yz * z_out);
        store(w + in, few(w + in) + xz * x_out + yz * y_out + zz * z_out);
      }
    }
    u[out] += sum(u_out);
    v[out] += sum(v_out);
    w[out] += sum(w_out);
  }
}

Matrix SymmetricBlocks::apply(const Matrix& density) const {
  RowMatrix padded = RowMatrix::Zero(3, filled(size()) / kBlocks);
  padded.leftCols(size()) = density.transpose();
  const bool worthwhile = values_.size() > kFewSymmetricEntries;
  const Index n_parts = worthwhile ? kParts : 1;
  // Work grows with the square of the index.
  const auto boundary = [&](Index part) {
    return static_cast<Index>(std::sqrt(static_cast<double>(part) / static_cast<double>(n_parts)) *
                              static_cast<double>(size()));
  };
  std::vector<RowMatrix> sums(static_cast<std::size_t>(n_parts), RowMatrix::Zero(3, padded.cols()));
  for_each_index(n_parts, worthwhile, [&](Index part) {
    const Index end = part + 1 == n_parts ? size() : boundary(part + 1);
    apply_columns(boundary(part), end, padded, sums[static_cast<std::size_t>(part)]);
  });
  for (Index part = 1; part < n_parts; ++part) sums[0] += sums[static_cast<std::size_t>(part)];
  return sums[0].leftCols(size()).transpose();
}

namespace {

/// Matrix entries below which waking a second thread costs more than it saves.
constexpr Index kParallelEntries = 1000000;
/// Up to this many densities are multiplied one by one; a solve applies an operator to fewer.
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

/// result = transposedᵗ · density, every entry by one thread.
template <class Result>
void multiply(const Matrix& transposed, const Eigen::Ref<const Matrix>& density, Result&& result) {
  // For few densities reading the matrix once each costs no more than the sums; for many a blocked product is faster.
  if (density.cols() > kFewDensities) {
    result = transposed.transpose() * density;
    return;
  }
  for_each_index(transposed.cols(), transposed.size() > kParallelEntries, [&](Index out) {
    for (Index f = 0; f < density.cols(); ++f) result(out, f) = transposed.col(out).dot(density.col(f));
  });
}

Matrix product(const Matrix& transposed, const Matrix& density) {
  Matrix result(transposed.cols(), density.cols());
  multiply(transposed, density, result);
  return result;
}

}  // namespace

Matrix ScalarOperator::apply(const Matrix& density) const {
  require_size("density", density.rows(), n_coefficients_);
  if (parts_.size() == 1 && parts_[0].transposed.rows() == n_coefficients_) {
    return product(parts_[0].transposed, density);
  }
  Matrix result = Matrix::Zero(density.rows(), density.cols());
  // Parts are many and small: allocating workspace for each would cost as much as its product.
  Matrix from(n_coefficients_, density.cols()), to(n_coefficients_, density.cols());
  for (const Part& part : parts_) {
    const auto n = static_cast<Index>(part.indices.size());
    from.topRows(n) = density(part.indices, Eigen::all);
    multiply(part.transposed, from.topRows(n), to.topRows(n));
    result(part.indices, Eigen::all) = to.topRows(n);
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
  require_density(density, n_rows(), active_);
  if (!active_.empty()) return scattered(apply_blocks(gathered(density, active_)), active_, density.rows());
  return apply_blocks(density);
}

Matrix StokesOperator::between(Index n_coefficients, const std::vector<Index>& entries) const {
  const std::vector<Index>& known = entries_.empty() ? active_ : entries_;
  // Position of each entry in the matrices, −1 if absent.
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
      const int block = kStokesBlock[entries[i] / n_coefficients][entries[j] / n_coefficients];
      result(i, j) = !entries_.empty()       ? on_entries_(place[j], place[i])
                     : symmetric_.size() > 0 ? symmetric_.at(block, place[i], place[j])
                                             : transposed_[block](place[j], place[i]);
    }
  }
  return result;
}

Matrix StokesOperator::apply_blocks(const Matrix& density) const {
  if (symmetric_.size() > 0) return symmetric_.apply(density);
  const Index n_in = transposed_[0].rows(), last = n_in / kTogether * kTogether;
  Matrix result(transposed_[0].cols(), 3);
  const double *x = density.col(0).data(), *y = density.col(1).data(), *z = density.col(2).data();
  for_each_index(transposed_[0].cols(), 6 * transposed_[0].size() > kParallelEntries, [&](Index out) {
    const auto block = [&](std::size_t i) { return transposed_[i].col(out).data(); };
    const double *xx = block(0), *xy = block(1), *xz = block(2), *yy = block(3), *yz = block(4), *zz = block(5);
    Few u{}, v{}, w{};
    for (Index i = 0; i < last; i += kTogether) {
      const Few x_in = few(x + i), y_in = few(y + i), z_in = few(z + i);
      u += few(xx + i) * x_in + few(xy + i) * y_in + few(xz + i) * z_in;
      v += few(xy + i) * x_in + few(yy + i) * y_in + few(yz + i) * z_in;
      w += few(xz + i) * x_in + few(yz + i) * y_in + few(zz + i) * z_in;
    }
    Vector3 rest(sum(u), sum(v), sum(w));
    for (Index i = last; i < n_in; ++i) {
      rest += Vector3(xx[i] * x[i] + xy[i] * y[i] + xz[i] * z[i], xy[i] * x[i] + yy[i] * y[i] + yz[i] * z[i],
                      xz[i] * x[i] + yz[i] * y[i] + zz[i] * z[i]);
    }
    result.row(out) = rest.transpose();
  });
  return result;
}

}  // namespace vehd
