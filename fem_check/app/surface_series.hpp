#pragma once

#include <memory>

#include "fem_check/types.hpp"
#include "meshes/harmonic_series.hpp"

namespace vehd::fem_check {

/// A field of the boundary-integral side as a function on γ.
class SurfaceSeries {
 public:
  explicit SurfaceSeries(const Eigen::MatrixXd& coefficients)
      : series_(std::make_shared<const meshes::HarmonicSeries>(coefficients)) {}

  /// [components x points].
  [[nodiscard]] Eigen::MatrixXd operator()(const SurfacePoints& points) const {
    return series_->values(points.direction);
  }
  [[nodiscard]] ScalarOnSurface scalar() const {
    return [series = series_](const SurfacePoints& points) { return Vector(series->values(points.direction).row(0)); };
  }

 private:
  std::shared_ptr<const meshes::HarmonicSeries> series_;
};

}  // namespace vehd::fem_check
