#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "bie/potentials/layer_operators.hpp"
#include "bie/potentials/longitude_sums.hpp"
#include "bie/potentials/operator_columns.hpp"
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

/// How many latitudes are analysed together: at high degrees the amplitudes of all would take twice the memory of the
/// operators, and adding up the operators in parts takes little time beside the kernels.
/// @param values_each  of one latitude
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
  // Images are made of whole rows in the order of kernels and coefficients.
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
    // Those that are swept, and after them their images.
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
