#include "bie/potentials/target_sweep.hpp"

#include <algorithm>
#include <optional>
#include <span>

#include "bie/sphere/harmonics.hpp"
#include "bie/sphere/small_product.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Targets that share the matrix products: enough columns for efficiency, few enough to stay in cache.
constexpr int kChunk = 2 * kLanes;

/// Number of batches of latitudes; latitudes with few targets share a chunk.
int batch_count(int n_latitudes, int n_targets) {
  const int shared = std::max(1, kChunk / n_targets);
  return (n_latitudes + shared - 1) / shared;
}

}  // namespace

TargetSweep::TargetSweep(const RotatedQuadrature& quadrature, const SphereTransform& transform, const Matrix& position,
                         const LayerSelection& selection, const std::vector<Reflection>& reflections, int fold)
    : quadrature_(quadrature),
      transform_(transform),
      position_(position),
      kernels_(selection),
      active_(quadrature.order, transform.azimuthal_order()),
      images_({reflections, fold}, kernels_, active_, transform.grid().n_phi),
      n_latitudes_(images_.flip() ? (transform.grid().n_theta + 1) / 2 : transform.grid().n_theta),
      n_evaluations_(evaluations_per_assembly(quadrature, transform, reflections, fold)) {
  require_size("position", position.rows(), n_coefficients(quadrature.order));
  require_size("target grid (order)", transform.grid().order, quadrature.order);
  SphereDerivatives x = transform.synthesize_gradient(position);
  area_vectors_.resize(x.value.rows(), 3);
  for (Index i = 0; i < area_vectors_.rows(); ++i) {
    area_vectors_.row(i) = Vector3(x.d1.row(i)).cross(Vector3(x.d2.row(i))).transpose();
    if (kernels_.plain) area_vectors_.row(i).normalize();
  }
  target_positions_ = std::move(x.value);
}

bool TargetSweep::is_parallel() const {
  // Kernel values below which waking a second thread costs more than it saves.
  constexpr std::uint64_t kParallelEvaluations = 50000;
  return n_evaluations_ > kParallelEvaluations;
}

void TargetSweep::run(const RowLayout& layout, Latitudes latitudes,
                      const std::function<void(int latitude, double* rows)>& use) const {
  const SphereGrid& grid = transform_.grid();
  const std::vector<int>& originals = images_.originals();
  const auto n_originals = static_cast<int>(originals.size());
  const Index n_rows = layout.all_longitudes ? grid.n_phi : n_originals;
  const int n_latitudes = latitudes.count(), n_batches = batch_count(n_latitudes, n_originals);
#pragma omp parallel if (is_parallel())
  {
    RowMatrix rows = RowMatrix::Zero(n_rows * ((n_latitudes + n_batches - 1) / n_batches), layout.width);
    // Made on first use: construction clears tables, and for few targets one of them is enough.
    std::optional<TargetRows> worker, last_worker;
    const auto fill_rows = [&](std::optional<TargetRows>& of_chunk, std::span<const Target> chunk) {
      if (!of_chunk) {
        of_chunk.emplace(TargetContext{quadrature_, kernels_, position_, grid.phi, transform_.azimuthal_order(),
                                       images_.in_mirror()},
                         layout.places, static_cast<int>(chunk.size()));
      }
      of_chunk->run(chunk, rows);
    };
    std::vector<Target> targets;
#pragma omp for schedule(dynamic, 1)
    for (int batch = 0; batch < n_batches; ++batch) {
      const int first = latitudes.first + batch * n_latitudes / n_batches;
      const int end = latitudes.first + (batch + 1) * n_latitudes / n_batches;
      targets.clear();
      for (int j = first; j < end; ++j) {
        for (int i = 0; i < n_originals; ++i) {
          const int k = originals[i];
          const Index point = Index{j} * grid.n_phi + k;
          targets.push_back({j, k, target_positions_.row(point), area_vectors_.row(point),
                             (j - first) * n_rows + (layout.all_longitudes ? k : i)});
        }
      }
      // Copies of the last target fill the last chunk.
      while (targets.size() % kLanes != 0) targets.push_back(Target(targets.back()));
      std::span<const Target> left(targets);
      for (; left.size() >= kChunk; left = left.subspan(kChunk)) fill_rows(worker, left.first(kChunk));
      if (!left.empty()) fill_rows(last_worker, left);
      for (int j = first; j < end; ++j) {
        auto of_latitude = rows.middleRows((j - first) * n_rows, n_rows);
        if (layout.all_longitudes) images_.fill(of_latitude.leftCols(kernels_.count * active_.count()));
        use(j, of_latitude.data());
      }
    }
  }
}

}  // namespace vehd
