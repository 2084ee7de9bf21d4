#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <numeric>
#include <utility>
#include <vector>

#include "bie/potentials/layer_operators.hpp"
#include "bie/potentials/longitude_sums.hpp"
#include "bie/potentials/target_images.hpp"
#include "bie/potentials/target_sweep.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/small_product.hpp"

namespace vehd {

std::uint64_t evaluations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                       const std::vector<Reflection>& reflections, int fold) {
  const SphereGrid& grid = transform.grid();
  const TargetImages images({reflections, fold}, KernelColumns({}), {quadrature.order, transform.azimuthal_order()},
                            grid.n_phi);
  const int n_latitudes = images.flip() ? (grid.n_theta + 1) / 2 : grid.n_theta;
  const std::uint64_t n_targets = std::uint64_t(n_latitudes) * images.originals().size();
  return n_targets * quadrature.n_nodes() / (images.in_mirror() ? 2 : 1);
}

void count_evaluations(const LayerSelection& selection, std::uint64_t evaluations, Instruments& instruments) {
  if (selection.laplace_single) instruments.count_kernel("laplace_single", evaluations);
  if (selection.laplace_double) instruments.count_kernel("laplace_double", evaluations);
  if (selection.laplace_adjoint) instruments.count_kernel("laplace_adjoint", evaluations);
  if (selection.laplace_hypersingular) instruments.count_kernel("laplace_hypersingular", evaluations);
  if (selection.stokes_single) instruments.count_kernel("stokes_single", evaluations);
  if (selection.stokes_double) instruments.count_kernel("stokes_double", evaluations);
}

namespace {

/// Arrangement of the columns of kernel rows without symmetry, and the operators made of them. Columns of a symmetric
/// Stokes single layer are arranged as in SymmetricBlocks, so that its columns are contiguous parts of the sums over
/// latitudes, and densities of a degree above that of the output are skipped. Columns of other kernels follow one
/// another, coefficients in the order of coefficient_index.
class OperatorColumns {
 public:
  /// @param kernels, active  must outlive this
  OperatorColumns(const KernelColumns& kernels, const ActiveCoefficients& active);

  /// Width of the rows, a multiple of kLanes.
  [[nodiscard]] Index width() const { return width_; }
  /// Column of each entry of [kernels * active coefficients], order-major.
  [[nodiscard]] const std::vector<Index>& columns() const { return columns_; }
  /// Result of LongitudeSums at all latitudes.
  struct Amplitudes {
    const double* values;
    const std::vector<int>& orders;
  };
  /// Adds sums of one mode over latitudes to the columns of the operators. Threads may process different modes.
  /// @param analysis  Gauss weight times harmonics of |m|, [latitudes x degrees]
  /// @param first     whether nothing has been added before
  void add(const Amplitudes& amplitudes, Index mode, const Matrix& analysis, bool first);
  /// Returns the operators; must be called once, after everything is added.
  [[nodiscard]] LayerOperators take(const LayerSelection& selection, Index n_coefficients);

 private:
  /// Stores a row of sums for one output coefficient, from one column on.
  void put(Index out, Index first_column, Index count, const double* from, bool first);

  const KernelColumns& kernels_;
  const ActiveCoefficients& active_;
  std::vector<int> degrees_;  ///< of the active coefficients
  Index width_ = 0;
  Index symmetric_width_ = 0;         ///< of the columns of the Stokes single layer, which come first
  std::vector<Index> first_columns_;  ///< of each kernel; unused for a symmetric Stokes single layer
  std::vector<Index> columns_;
  SymmetricBlocks symmetric_;
  std::vector<Matrix> operators_;  ///< per kernel, transposed
};

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
  // Coefficients of one order are adjacent in the order-major order.
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

/// Number of latitudes analysed together: at high degrees the amplitudes of all would take twice the memory of the
/// operators, and summing the operators in parts takes little time compared with the kernels.
/// @param values_each  number of amplitudes of one latitude
int latitudes_at_once(int n_latitudes, int images_each, Index values_each) {
  constexpr Index most_values = Index{1} << 25;  // 256 MB
  const auto room = static_cast<int>(std::clamp<Index>(most_values / (images_each * values_each), 1, n_latitudes));
  const int n_blocks = (n_latitudes + room - 1) / room;
  return (n_latitudes + n_blocks - 1) / n_blocks;
}

}  // namespace

LayerOperators assemble_layer_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                        const Matrix& position, const LayerSelection& selection,
                                        Instruments& instruments, const std::vector<Reflection>& reflections,
                                        int fold) {
  const TargetSweep sweep(quadrature, transform, position, selection, reflections, fold);
  const KernelColumns& kernels = sweep.kernels();
  if (kernels.count == 0) return {};
  const SphereGrid& grid = transform.grid();
  const ActiveCoefficients& active = sweep.active();
  const TargetImages& images = sweep.images();
  const LongitudeSums longitudes(grid, transform.azimuthal_order());
  const std::vector<int>& orders = longitudes.orders();
  const auto n_modes = std::ssize(orders);
  OperatorColumns operators(kernels, active);
  const std::vector<Index>& columns = operators.columns();
  const Index width = operators.width(), n_entries = std::ssize(columns);
  // Images are computed from whole rows in the order of kernels and coefficients.
  const bool has_images = std::ssize(images.originals()) < grid.n_phi;
  TargetSweep::RowLayout layout{width, {}, true};
  if (has_images) {
    layout.width = filled_up(n_entries);
  } else {
    layout.places.columns = columns;
  }
  Vector flip_signs;
  if (images.flip()) {
    flip_signs.setZero(width);
    for (Index i = 0; i < n_entries; ++i) flip_signs[columns[i]] = images.flip_signs()[i];
  }
  const int at_once = latitudes_at_once(sweep.n_latitudes(), images.flip() ? 2 : 1, width * n_modes);
  Vector amplitudes;
  for (int first = 0; first < sweep.n_latitudes(); first += at_once) {
    const TargetSweep::Latitudes block{first, std::min(first + at_once, sweep.n_latitudes())};
    // Swept latitudes, then their images.
    std::vector<Index> latitudes(block.count());
    std::iota(latitudes.begin(), latitudes.end(), Index{first});
    if (images.flip()) {
      for (int j = block.first; j < block.end; ++j) {
        if (grid.n_theta - 1 - j != j) latitudes.push_back(grid.n_theta - 1 - j);
      }
    }
    const auto n_latitudes = std::ssize(latitudes);
    amplitudes.resize(width * n_latitudes * n_modes);
    sweep.run(layout, block, [&](int j, const double* rows) {
      RowMatrix arranged;
      if (has_images) {
        arranged.setZero(grid.n_phi, width);
        for (Index k = 0; k < grid.n_phi; ++k) {
          for (Index i = 0; i < n_entries; ++i) arranged(k, columns[i]) = rows[k * layout.width + i];
        }
        rows = arranged.data();
      }
      const Index latitude = j - block.first, image = block.count() + latitude;
      longitudes.run(rows, width, {latitude, n_latitudes}, amplitudes.data());
      if (image >= n_latitudes) return;
      for (Index column = 0; column < width; column += LongitudeSums::kPiece) {
        const Index count = std::min(LongitudeSums::kPiece, width - column);
        double* piece = amplitudes.data() + column * n_latitudes * n_modes;
        for (Index mode = 0; mode < n_modes; ++mode) {
          const auto at = [&](Index which) { return Vector::Map(piece + (which * n_modes + mode) * count, count); };
          at(image) = images.flip()->azimuthal_parity(orders[static_cast<std::size_t>(mode)]) *
                      at(latitude).cwiseProduct(flip_signs.segment(column, count));
        }
      }
    });

#pragma omp parallel for schedule(dynamic, 1) if (sweep.is_parallel())
    for (Index mode = 0; mode < n_modes; ++mode) {
      const int m = std::abs(orders[static_cast<std::size_t>(mode)]);
      operators.add({amplitudes.data(), orders}, mode, quadrature.target_analysis[m](latitudes, Eigen::all),
                    first == 0);
    }
  }
  count_evaluations(selection, sweep.n_evaluations(), instruments);
  return operators.take(selection, n_coefficients(quadrature.order));
}

}  // namespace vehd
