#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "bie/potentials/layer_operators.hpp"
#include "bie/potentials/longitude_sums.hpp"
#include "bie/potentials/small_product.hpp"
#include "bie/potentials/target_images.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Targets that share the matrix products: enough columns for efficiency, few enough to stay in cache.
constexpr std::size_t kChunk = 8;

/// Latitudes that share a chunk where each has few targets.
int batch_count(int n_latitudes, int n_targets) {
  const int shared = std::max(1, static_cast<int>(kChunk) / n_targets);
  return (n_latitudes + shared - 1) / shared;
}

}  // namespace

std::uint64_t evaluations_per_assembly(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                       const std::vector<Reflection>& reflections, int fold) {
  const SphereGrid& grid = transform.grid();
  const TargetImages images({reflections, fold}, KernelColumns({}), {quadrature.order, transform.azimuthal_order()},
                            grid.n_phi);
  const int n_latitudes = images.flip() ? (grid.n_theta + 1) / 2 : grid.n_theta;
  const std::uint64_t n_targets = std::uint64_t(n_latitudes) * images.originals().size();
  return n_targets * quadrature.n_nodes() / (images.in_mirror() ? 2 : 1);
}

LayerOperators assemble_layer_operators(const RotatedQuadrature& quadrature, const SphereTransform& transform,
                                        const Matrix& position, const LayerSelection& selection,
                                        Instruments& instruments, const std::vector<Reflection>& reflections,
                                        int fold) {
  const int order = quadrature.order;
  const int azimuthal_order = transform.azimuthal_order();
  require_size("position", position.rows(), n_coefficients(order));
  const SphereGrid& grid = transform.grid();
  require_size("target grid (order)", grid.order, order);
  const KernelColumns kernels(selection);
  if (kernels.count == 0) return {};

  const SphereDerivatives x = transform.synthesize_gradient(position);
  Matrix area_vector(grid.n_points(), 3);  // J n
  for (Index i = 0; i < area_vector.rows(); ++i) {
    area_vector.row(i) = Vector3(x.d1.row(i)).cross(Vector3(x.d2.row(i))).transpose();
  }

  const ActiveCoefficients active(order, azimuthal_order);
  const TargetImages images({reflections, fold}, kernels, active, grid.n_phi);
  const std::vector<int>& originals = images.originals();
  const Index n = active.count();
  const LongitudeSums longitudes(grid, azimuthal_order);
  const Index n_modes = longitudes.n_modes();
  const int n_originals = static_cast<int>(originals.size());
  const int n_latitudes = images.flip() ? (grid.n_theta + 1) / 2 : grid.n_theta;
  const int n_batches = batch_count(n_latitudes, n_originals);
  const std::uint64_t evaluations = evaluations_per_assembly(quadrature, transform, reflections, fold);
  // Kernel values below which waking a second thread costs more than it saves.
  constexpr std::uint64_t kParallelEvaluations = 50000;
  const Index n_columns = kernels.count * n;
  const Index width = (n_columns + kLanes - 1) / kLanes * kLanes;
  // Per Fourier mode of the target azimuth: [kernels * coefficients x latitudes].
  std::vector<Matrix> modes(n_modes, Matrix(width, grid.n_theta));
#pragma omp parallel if (evaluations > kParallelEvaluations)
  {
    TargetRows worker(quadrature, kernels, position, azimuthal_order, static_cast<int>(kChunk), images.in_mirror());
    RowMatrix rows = RowMatrix::Zero(grid.n_phi * ((n_latitudes + n_batches - 1) / n_batches), width);
    std::vector<Target> targets;
    std::vector<double*> amplitudes(n_modes);
#pragma omp for schedule(dynamic, 1)
    for (int batch = 0; batch < n_batches; ++batch) {
      const int first_latitude = batch * n_latitudes / n_batches;
      const int end_latitude = (batch + 1) * n_latitudes / n_batches;
      targets.clear();
      for (int j = first_latitude; j < end_latitude; ++j) {
        for (const int k : originals) {
          const Index i = Index{j} * grid.n_phi + k;
          targets.push_back(
              {j, grid.phi[k], x.value.row(i), area_vector.row(i), Index{j - first_latitude} * grid.n_phi + k});
        }
      }
      // Copies of the last target fill the last chunk.
      while (targets.size() % kChunk != 0) targets.push_back(Target(targets.back()));
      for (std::size_t done = 0; done < targets.size(); done += kChunk) {
        worker.run(std::span(targets).subspan(done, kChunk), rows);
      }
      for (int j = first_latitude; j < end_latitude; ++j) {
        auto rows_of_latitude = rows.middleRows(Index{j - first_latitude} * grid.n_phi, grid.n_phi);
        images.fill(rows_of_latitude.leftCols(n_columns));
        for (Index mode = 0; mode < n_modes; ++mode) amplitudes[mode] = modes[mode].col(j).data();
        longitudes.run(rows_of_latitude.data(), width, amplitudes);
        if (!images.flip()) continue;
        for (Index mode = 0; mode < n_modes; ++mode) {
          const int m = static_cast<int>(mode <= azimuthal_order ? mode : azimuthal_order - mode);
          modes[mode].col(grid.n_theta - 1 - j).head(n_columns) =
              images.flip()->azimuthal_parity(m) *
              modes[mode].col(j).head(n_columns).cwiseProduct(images.flip_signs().transpose());
        }
      }
    }
  }

  std::vector<Matrix> operators(kernels.count, Matrix(n, n));
#pragma omp parallel for schedule(dynamic, 1) if (evaluations > kParallelEvaluations)
  for (Index mode = 0; mode < n_modes; ++mode) {
    const int m = static_cast<int>(mode <= azimuthal_order ? mode : mode - azimuthal_order);
    const Matrix product = modes[mode].topRows(n_columns) * quadrature.target_analysis[m];
    for (Index i = 0; i < n; ++i) {
      if (active.m[i] != (mode <= azimuthal_order ? m : -m)) continue;
      for (int c = 0; c < kernels.count; ++c) {
        const double* from = product.col(active.n[i] - m).data() + c * n;
        double* to = operators[c].col(active.position[i]).data();
        for (Index k = 0; k < n; ++k) to[active.position[k]] = from[k];
      }
    }
  }

  LayerOperators result;
  if (selection.laplace_single) {
    result.laplace_single = ScalarOperator(std::move(operators[kernels.single]), active.indices);
    instruments.count_kernel("laplace_single", evaluations);
  }
  if (selection.laplace_double) {
    result.laplace_double = ScalarOperator(std::move(operators[kernels.double_layer]), active.indices);
    instruments.count_kernel("laplace_double", evaluations);
  }
  if (selection.laplace_adjoint) {
    result.laplace_adjoint = ScalarOperator(std::move(operators[kernels.adjoint]), active.indices);
    instruments.count_kernel("laplace_adjoint", evaluations);
  }
  const auto stokes_operator = [&](int first) {
    std::array<Matrix, 6> blocks;
    for (int c = 0; c < 6; ++c) blocks[c] = std::move(operators[first + c]);
    return StokesOperator(std::move(blocks), active.indices);
  };
  if (selection.stokes_single) {
    result.stokes_single = stokes_operator(kernels.stokes);
    instruments.count_kernel("stokes_single", evaluations);
  }
  if (selection.stokes_double) {
    result.stokes_double = stokes_operator(kernels.stokes_double);
    instruments.count_kernel("stokes_double", evaluations);
  }
  return result;
}

}  // namespace vehd
