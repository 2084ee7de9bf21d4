#pragma once

#include <memory>
#include <vector>

#include "fem_check/types.hpp"
#include "meshes/harmonic_series.hpp"

namespace vehd::fem_check {

/// A field of the boundary-integral side as a function on γ.
class SurfaceSeries {
 public:
  /// @param coefficients  on a single membrane, [n_coefficients x components]
  explicit SurfaceSeries(const Eigen::MatrixXd& coefficients) : SurfaceSeries(std::vector{coefficients}) {}
  /// @param of_vesicles  coefficients on the membrane of each vesicle, [n_coefficients x components]
  explicit SurfaceSeries(const std::vector<Eigen::MatrixXd>& of_vesicles) {
    for (const Eigen::MatrixXd& coefficients : of_vesicles) {
      series_.push_back(std::make_shared<const meshes::HarmonicSeries>(coefficients));
    }
  }

  /// Values at points of γ, [components x points].
  [[nodiscard]] Eigen::MatrixXd operator()(const SurfacePoints& points) const {
    if (series_.size() == 1) return series_.front()->values(points.direction);
    Eigen::MatrixXd result(series_.front()->n_columns(), points.size());
    for (std::size_t vesicle = 0; vesicle < series_.size(); ++vesicle) {
      const std::vector<Eigen::Index> columns = points.of_vesicle(static_cast<int>(vesicle));
      result(Eigen::all, columns) = series_[vesicle]->values(points.direction(Eigen::all, columns));
    }
    return result;
  }
  [[nodiscard]] ScalarOnSurface scalar() const {
    return [*this](const SurfacePoints& points) { return Vector((*this)(points).row(0)); };
  }

 private:
  std::vector<std::shared_ptr<const meshes::HarmonicSeries>> series_;
};

}  // namespace vehd::fem_check
