#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>
#include <vector>

#include "bie/potentials/layer_operators.hpp"
#include "bie/potentials/longitude_sums.hpp"
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
  const Index n = active.count();
  const Index n_modes = longitudes.n_modes();
  const Index n_columns = kernels.count * n;
  const Index width = filled_up(n_columns);
  const auto order_of_mode = [&](Index mode) {
    return static_cast<int>(mode <= transform.azimuthal_order() ? mode : transform.azimuthal_order() - mode);
  };
  const auto is_symmetric = [&](int kernel) {
    return kernels.stokes >= 0 && kernel >= kernels.stokes && kernel < kernels.stokes + SymmetricBlocks::kBlocks;
  };
  std::vector<Matrix> operators(kernels.count);
  for (int c = 0; c < kernels.count; ++c) {
    if (!is_symmetric(c)) operators[c].resize(n, n);
  }
  SymmetricBlocks symmetric;
  if (selection.stokes_single) {
    std::vector<int> degrees = active.n;
    std::sort(degrees.begin(), degrees.end());
    symmetric = SymmetricBlocks(std::move(degrees));
  }
  const int at_once = latitudes_at_once(sweep.n_latitudes(), images.flip() ? 2 : 1, width * n_modes);
  std::vector<Matrix> modes(n_modes);
  for (int first = 0; first < sweep.n_latitudes(); first += at_once) {
    const TargetSweep::Latitudes block{first, std::min(first + at_once, sweep.n_latitudes())};
    // Those that are swept, and after them their images: latitudes of the columns of the modes.
    std::vector<Index> latitudes(block.count());
    std::iota(latitudes.begin(), latitudes.end(), Index{first});
    if (images.flip()) {
      for (int j = block.first; j < block.end; ++j) {
        if (grid.n_theta - 1 - j != j) latitudes.push_back(grid.n_theta - 1 - j);
      }
    }
    // Per Fourier mode of the target azimuth: [kernels * coefficients x latitudes].
    for (Matrix& mode : modes) mode.resize(width, static_cast<Index>(latitudes.size()));
    sweep.run({width, {}, true}, block, [&](int j, const double* rows) {
      const Index column = j - block.first, image = block.count() + column;
      std::vector<double*> amplitudes;
      for (Matrix& mode : modes) amplitudes.push_back(mode.col(column).data());
      longitudes.run(rows, width, amplitudes);
      if (image >= static_cast<Index>(latitudes.size())) return;
      for (Index i = 0; i < n_modes; ++i) {
        modes[i].col(image).head(n_columns) =
            images.flip()->azimuthal_parity(order_of_mode(i)) *
            modes[i].col(column).head(n_columns).cwiseProduct(images.flip_signs().transpose());
      }
    });

#pragma omp parallel for schedule(dynamic, 1) if (sweep.is_parallel())
    for (Index mode = 0; mode < n_modes; ++mode) {
      const int m = std::abs(order_of_mode(mode));
      const Matrix product = modes[mode].topRows(n_columns) * quadrature.target_analysis[m](latitudes, Eigen::all);
      if (block.end == sweep.n_latitudes()) modes[mode].resize(0, 0);
      for (Index i = 0; i < n; ++i) {
        if (active.m[i] != order_of_mode(mode)) continue;
        for (int c = 0; c < kernels.count; ++c) {
          const double* from = product.col(active.n[i] - m).data() + c * n;
          if (is_symmetric(c)) {
            double* to = symmetric.column(active.position[i]);
            for (Index k = 0; k < n; ++k) {
              if (active.n[k] <= active.n[i]) to[symmetric.place(c - kernels.stokes, active.position[k])] += from[k];
            }
            continue;
          }
          double* to = operators[c].col(active.position[i]).data();
          if (first == 0) {
            for (Index k = 0; k < n; ++k) to[active.position[k]] = from[k];
          } else {
            for (Index k = 0; k < n; ++k) to[active.position[k]] += from[k];
          }
        }
      }
    }
  }

  LayerOperators result;
  const auto scalar_operator = [&](int kernel) {
    std::vector<Index> indices = active.indices;
    if (indices.empty()) {
      indices.resize(n);
      std::iota(indices.begin(), indices.end(), Index{0});
    }
    std::vector<ScalarOperator::Part> parts;
    parts.push_back({std::move(indices), std::move(operators[kernel])});
    return ScalarOperator(n_coefficients(quadrature.order), std::move(parts));
  };
  if (selection.laplace_single) result.laplace_single = scalar_operator(kernels.single);
  if (selection.laplace_double) result.laplace_double = scalar_operator(kernels.double_layer);
  if (selection.laplace_adjoint) result.laplace_adjoint = scalar_operator(kernels.adjoint);
  if (selection.stokes_single) {
    symmetric.symmetrize();
    result.stokes_single = StokesOperator(std::move(symmetric), active.indices);
  }
  if (selection.stokes_double) {
    std::array<Matrix, 6> blocks;
    for (int c = 0; c < 6; ++c) blocks[c] = std::move(operators[kernels.stokes_double + c]);
    result.stokes_double = StokesOperator(std::move(blocks), active.indices);
  }
  count_evaluations(selection, sweep.n_evaluations(), instruments);
  return result;
}

}  // namespace vehd
