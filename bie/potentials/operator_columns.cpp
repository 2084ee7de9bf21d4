#include "bie/potentials/operator_columns.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>

#include "bie/potentials/longitude_sums.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

OperatorColumns::OperatorColumns(const KernelColumns& kernels, const ActiveCoefficients& active)
    : kernels_(kernels),
      active_(active),
      degrees_(active.n),
      first_columns_(static_cast<std::size_t>(kernels.count)),
      operators_(static_cast<std::size_t>(kernels.count)) {
  std::sort(degrees_.begin(), degrees_.end());
  if (kernels.has_symmetric_stokes()) {
    symmetric_ = SymmetricBlocks(degrees_);
    symmetric_width_ = SymmetricBlocks::filled(active.count());
  }
  Index next = symmetric_width_;
  for (int kernel = 0; kernel < kernels.count; ++kernel) {
    const auto c = static_cast<std::size_t>(kernel);
    const int block = kernel - kernels.stokes;
    const bool is_symmetric = kernels.has_symmetric_stokes() && block >= 0 && block < SymmetricBlocks::kBlocks;
    if (!is_symmetric) {
      first_columns_[c] = next;
      next += active.count();
      operators_[c].resize(active.count(), active.count());
    }
    for (const Index position : active.position) {
      columns_.push_back(is_symmetric ? SymmetricBlocks::place(block, position) : first_columns_[c] + position);
    }
  }
  width_ = filled_up(next);
}

void OperatorColumns::put(Index out, Index first_column, Index count, const double* from, bool first) {
  const auto take = [&](const double* values, Index n, double* to) {
    if (first) {
      std::copy_n(values, n, to);
    } else {
      for (Index i = 0; i < n; ++i) to[i] += values[i];
    }
  };
  if (first_column < symmetric_width_) {
    const Index end = std::min(first_column + count, SymmetricBlocks::filled(symmetric_.n_in(out)));
    if (end > first_column) take(from, end - first_column, symmetric_.column(out) + first_column);
  }
  for (std::size_t c = 0; c < operators_.size(); ++c) {
    if (operators_[c].size() == 0) continue;
    const Index begin = std::max(first_column, first_columns_[c]);
    const Index end = std::min(first_column + count, first_columns_[c] + active_.count());
    if (end > begin) take(from + (begin - first_column), end - begin, &operators_[c](begin - first_columns_[c], out));
  }
}

void OperatorColumns::add(const Amplitudes& amplitudes, Index mode, const Matrix& analysis, bool first) {
  const int order = amplitudes.orders[static_cast<std::size_t>(mode)], m = std::abs(order);
  const Index n_modes = std::ssize(amplitudes.orders);
  const Index n_latitudes = analysis.rows(), n_degrees = analysis.cols();
  // Coefficients of one order stand together in the order-major order.
  const Index own = std::find(active_.m.begin(), active_.m.end(), order) - active_.m.begin();
  std::vector<double> sums(static_cast<std::size_t>(n_degrees * LongitudeSums::kPiece));
  for (Index column = 0; column < width_; column += LongitudeSums::kPiece) {
    const Index count = std::min(LongitudeSums::kPiece, width_ - column);
    Index lowest = 0;
    if (column + count <= symmetric_width_) {
      const int degree = degrees_[static_cast<std::size_t>(SymmetricBlocks::first_in(column))];
      lowest = std::max(0, degree - m);
    }
    small_product(n_degrees - lowest, n_latitudes, count, {analysis.col(lowest).data(), n_latitudes, 1},
                  amplitudes.values + (column * n_latitudes * n_modes + mode * count), n_modes * count, sums.data(),
                  count);
    for (Index i = lowest; i < n_degrees; ++i) {
      put(active_.position[static_cast<std::size_t>(own + i)], column, count, sums.data() + (i - lowest) * count,
          first);
    }
  }
}

LayerOperators OperatorColumns::take(const LayerSelection& selection, Index n_coefficients) {
  LayerOperators result;
  const auto scalar_operator = [&](int kernel) {
    std::vector<Index> indices = active_.indices;
    if (indices.empty()) {
      indices.resize(static_cast<std::size_t>(active_.count()));
      std::iota(indices.begin(), indices.end(), Index{0});
    }
    std::vector<ScalarOperator::Part> parts;
    parts.push_back({std::move(indices), std::move(operators_[static_cast<std::size_t>(kernel)])});
    return ScalarOperator(n_coefficients, std::move(parts));
  };
  if (selection.laplace_single) result.laplace_single = scalar_operator(kernels_.single);
  if (selection.laplace_double) result.laplace_double = scalar_operator(kernels_.double_layer);
  if (selection.laplace_adjoint) result.laplace_adjoint = scalar_operator(kernels_.adjoint);
  if (selection.laplace_hypersingular) result.laplace_hypersingular = scalar_operator(kernels_.hypersingular);
  const auto stokes_operator = [&](int first_kernel) {
    std::array<Matrix, 6> blocks;
    for (int c = 0; c < 6; ++c) blocks[c] = std::move(operators_[static_cast<std::size_t>(first_kernel + c)]);
    return StokesOperator(std::move(blocks), active_.indices);
  };
  if (kernels_.has_symmetric_stokes()) {
    symmetric_.symmetrize();
    result.stokes_single = StokesOperator(std::move(symmetric_), active_.indices);
  } else if (selection.stokes_single) {
    result.stokes_single = stokes_operator(kernels_.stokes);
  }
  if (selection.stokes_double) result.stokes_double = stokes_operator(kernels_.stokes_double);
  return result;
}

}  // namespace vehd
