#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "bie/potentials/layer_operators.hpp"
#include "bie/potentials/operator_blocks.hpp"
#include "bie/potentials/target_sweep.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {

namespace {

/// Sums over the longitudes of the targets for the orders of a block's output.
struct ModeSums {
  std::vector<int> orders;
  RowMatrix table;            ///< [orders x rows]
  std::vector<Matrix> modes;  ///< per order [width x latitudes]
};

ModeSums mode_sums(const OperatorBlock& block, const SphereGrid& grid, const std::vector<int>& longitudes,
                   const std::vector<int>& multiplicities, int n_latitudes) {
  ModeSums sums;
  for (const Index i : block.out) sums.orders.push_back(order_of_index(i));
  std::sort(sums.orders.begin(), sums.orders.end());
  sums.orders.erase(std::unique(sums.orders.begin(), sums.orders.end()), sums.orders.end());
  sums.table.resize(static_cast<Index>(sums.orders.size()), static_cast<Index>(longitudes.size()));
  for (Index row = 0; row < sums.table.rows(); ++row) {
    const int m = sums.orders[row];
    for (Index i = 0; i < sums.table.cols(); ++i) {
      const double phi = grid.phi[longitudes[i]];
      const double scale = (m == 0 ? 1.0 : 2.0) / grid.n_phi * multiplicities[i];
      sums.table(row, i) = scale * (m < 0 ? std::sin(-m * phi) : std::cos(m * phi));
    }
    sums.modes.emplace_back(block.width(), n_latitudes);
  }
  return sums;
}

/// Analyses the amplitudes of one order at all latitudes into the degrees of the block's output.
void analyse_latitudes(const OperatorBlock& block, int order, const Matrix& amplitudes, const Matrix& analysis,
                       std::vector<Matrix>& matrices) {
  const int m = std::abs(order);
  std::vector<Index> outputs, degrees;
  for (std::size_t i = 0; i < block.out.size(); ++i) {
    if (order_of_index(block.out[i]) != order) continue;
    outputs.push_back(static_cast<Index>(i));
    degrees.push_back(degree_of(block.out[i]) - m);
  }
  const Matrix table = analysis(Eigen::all, degrees);
  const Matrix product = amplitudes * table;
  for (const OperatorBlock::Destination& to : block.destinations) {
    const auto kernel = std::find(block.kernels.begin(), block.kernels.end(), to.kernel) - block.kernels.begin();
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      matrices[to.matrix].col(to.first_out + outputs[i]).segment(to.first_in, block.n_in()) =
          product.col(static_cast<Index>(i)).segment(kernel * block.n_in(), block.n_in());
    }
  }
}

/// Symmetrises a matrix as SymmetricBlocks does.
void symmetrize(const std::vector<Index>& entries, Index n_all, Matrix& transposed) {
  std::vector<int> degrees;
  for (const Index entry : entries) degrees.push_back(degree_of(entry % n_all));
  const Index n = std::ssize(degrees);
  // Size of a square tile that stays in cache with its mirror image.
  constexpr Index kTogether = 32;
  for (Index first_j = 0; first_j < n; first_j += kTogether) {
    for (Index first_i = 0; first_i <= first_j; first_i += kTogether) {
      for (Index j = first_j; j < std::min(first_j + kTogether, n); ++j) {
        for (Index i = first_i; i < std::min(first_i + kTogether, j); ++i) {
          const int change = degrees[static_cast<std::size_t>(j)] - degrees[static_cast<std::size_t>(i)];
          double &of_i = transposed(j, i), &of_j = transposed(i, j);
          of_i = of_j = change > 0 ? of_j : change < 0 ? of_i : 0.5 * (of_i + of_j);
        }
      }
    }
  }
}

}  // namespace

LayerOperators assemble_symmetric_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                            const Matrix& position, const LayerSelection& selection,
                                            Instruments& instruments, const SymmetrySubspace& subspace, int fold) {
  if (!subspace.symmetry().any()) {
    return assemble_layer_operators(quadrature, transform, position, selection, instruments);
  }
  const TargetSweep sweep(quadrature, transform, position, selection, subspace.symmetry().reflections, fold);
  const KernelColumns& kernels = sweep.kernels();
  if (kernels.count == 0) return {};
  const SphereGrid& grid = transform.grid();
  const ActiveCoefficients& active = sweep.active();
  const Index n_all = n_coefficients(quadrature.order);

  const SymmetricLayout operators = symmetric_layout(kernels, subspace, transform.azimuthal_order());
  const std::vector<OperatorBlock>& blocks = operators.blocks;
  std::vector<Matrix> matrices;
  for (const Index size : operators.sizes) matrices.emplace_back(size, size);

  // Column of each entry of a whole row in the blocks, −1 for none.
  const Index n_columns = kernels.count * active.count();
  std::vector<Index> order_major(n_all, -1);
  for (Index i = 0; i < active.count(); ++i) order_major[coefficient_index(active.n[i], active.m[i])] = i;
  std::vector<Index> columns(n_columns, -1);
  for (const OperatorBlock& block : blocks) {
    Index column = block.first_column;
    for (const int kernel : block.kernels) {
      for (const Index i : block.in) columns[kernel * active.count() + order_major[i]] = column++;
    }
  }
  const Index width = operators.width();

  // Rotations mix components, so their images must be computed; under reflections all images contribute equally.
  const bool turned = fold > 1;
  std::vector<int> longitudes = sweep.images().originals();
  std::vector<int> multiplicities = sweep.images().multiplicities();
  if (turned) {
    longitudes.resize(grid.n_phi);
    std::iota(longitudes.begin(), longitudes.end(), 0);
    multiplicities.assign(grid.n_phi, 1);
  }
  std::vector<ModeSums> sums;
  for (const OperatorBlock& block : blocks) {
    sums.push_back(mode_sums(block, grid, longitudes, multiplicities, sweep.n_latitudes()));
  }
  TargetSweep::RowLayout layout;
  layout.all_longitudes = turned;
  layout.width = turned ? n_columns : width;
  if (!turned) layout.places.columns = columns;
  layout.places.degrees = degree_parities(kernels, subspace, turned);
  sweep.run(layout, {0, sweep.n_latitudes()}, [&](int j, const double* rows) {
    const auto n_rows = static_cast<Index>(longitudes.size());
    RowMatrix gathered;
    if (turned) {
      gathered.setZero(n_rows, width);
      for (Index i = 0; i < n_columns; ++i) {
        if (columns[i] < 0) continue;
        for (Index k = 0; k < n_rows; ++k) gathered(k, columns[i]) = rows[k * n_columns + i];
      }
      rows = gathered.data();
    }
    RowMatrix amplitudes;
    for (std::size_t b = 0; b < blocks.size(); ++b) {
      const Index of_block = blocks[b].width();
      amplitudes.resize(sums[b].table.rows(), of_block);
      small_product(amplitudes.rows(), n_rows, of_block, {sums[b].table.data(), n_rows, 1},
                    rows + blocks[b].first_column, width, amplitudes.data(), of_block);
      for (Index i = 0; i < amplitudes.rows(); ++i) sums[b].modes[i].col(j) = amplitudes.row(i).transpose();
    }
  });

  // A latitude and its image contribute equally; the equator is its own image.
  Vector shares = Vector::Ones(sweep.n_latitudes());
  if (sweep.images().flip()) shares.head(grid.n_theta / 2).array() = 2.0;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
#pragma omp parallel for schedule(dynamic, 1) if (sweep.is_parallel())
    for (std::size_t i = 0; i < sums[b].orders.size(); ++i) {
      const int m = sums[b].orders[i];
      const Matrix analysis = shares.asDiagonal() * quadrature.target_analysis[std::abs(m)].topRows(shares.size());
      analyse_latitudes(blocks[b], m, sums[b].modes[i], analysis, matrices);
      sums[b].modes[i].resize(0, 0);
    }
  }

  LayerOperators result;
  const auto scalar_operator = [&](int kernel) {
    std::vector<ScalarOperator::Part> parts;
    for (std::size_t i = 0; i < operators.classes.size(); ++i) {
      parts.push_back({operators.classes[i], std::move(matrices[operators.first_matrix[kernel] + i])});
    }
    return ScalarOperator(n_all, std::move(parts));
  };
  if (selection.laplace_single) result.laplace_single = scalar_operator(kernels.single);
  if (selection.laplace_double) result.laplace_double = scalar_operator(kernels.double_layer);
  if (selection.laplace_adjoint) result.laplace_adjoint = scalar_operator(kernels.adjoint);
  if (selection.laplace_hypersingular) result.laplace_hypersingular = scalar_operator(kernels.hypersingular);
  const auto stokes_operator = [&](int kernel) {
    return StokesOperator(n_all, operators.entries, std::move(matrices[operators.first_matrix[kernel]]));
  };
  if (selection.stokes_single) {
    if (kernels.has_symmetric_stokes()) {
      symmetrize(operators.entries, n_all, matrices[operators.first_matrix[kernels.stokes]]);
    }
    result.stokes_single = stokes_operator(kernels.stokes);
  }
  if (selection.stokes_double) result.stokes_double = stokes_operator(kernels.stokes_double);
  count_evaluations(selection, sweep.n_evaluations(), instruments);
  return result;
}

}  // namespace vehd
