#include "bie/potentials/symmetric_blocks.hpp"

#include <algorithm>
#include <cmath>

#include "bie/potentials/few_nodes.hpp"
#include "bie/support/parallel.hpp"

namespace vehd {

namespace {

/// Entries below which waking a second thread costs more than it saves.
constexpr Index kFewSymmetricEntries = 250000;
/// Columns are shared out in as many parts of equal work, each with sums of its own, whatever the number of threads.
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
      // Each entry of the diagonal is met twice, as row and as column.
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

}  // namespace vehd
