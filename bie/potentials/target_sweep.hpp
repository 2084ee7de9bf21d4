#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bie/potentials/target_images.hpp"
#include "bie/potentials/target_rows.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// The kernel rows of all targets that an assembly needs, latitude by latitude.
class TargetSweep {
 public:
  /// Arguments as in assemble_layer_operators; they must outlive the sweep.
  TargetSweep(const RotatedQuadrature& quadrature, const SphereTransform& transform, const Matrix& position,
              const LayerSelection& selection, const std::vector<Reflection>& reflections, int fold);

  [[nodiscard]] const KernelColumns& kernels() const { return kernels_; }
  [[nodiscard]] const ActiveCoefficients& active() const { return active_; }
  [[nodiscard]] const TargetImages& images() const { return images_; }
  /// Number of latitudes that are swept: the northern ones only if a reflection maps them to the southern ones.
  [[nodiscard]] int n_latitudes() const { return n_latitudes_; }
  /// Kernel evaluations of each operator, as evaluations_per_assembly.
  [[nodiscard]] std::uint64_t n_evaluations() const { return n_evaluations_; }
  /// Whether there is enough work for a second thread.
  [[nodiscard]] bool is_parallel() const;

  /// Layout of the rows.
  struct RowLayout {
    Index width = 0;  ///< a multiple of kLanes
    RowPlaces places;
    /// A row for each longitude, with the images filled in; otherwise rows of the originals only.
    bool all_longitudes = false;
  };
  /// A range of latitudes, `end` excluded.
  struct Latitudes {
    int first, end;
    [[nodiscard]] int count() const { return end - first; }
  };
  /// @param use  called with each latitude and its rows, [longitudes or originals x width], by any thread
  void run(const RowLayout& layout, Latitudes latitudes,
           const std::function<void(int latitude, double* rows)>& use) const;

 private:
  const RotatedQuadrature& quadrature_;
  const SphereTransform& transform_;
  const Matrix& position_;
  KernelColumns kernels_;
  ActiveCoefficients active_;
  TargetImages images_;
  int n_latitudes_;
  std::uint64_t n_evaluations_;
  Matrix target_positions_, area_vectors_;  ///< [n_points x 3], the latter as in Target
};

}  // namespace vehd
