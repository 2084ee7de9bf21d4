#pragma once

#include <memory>

#include "bie/sphere/transform.hpp"
#include "bie/stepping/symmetry.hpp"

namespace vehd {

/// Numerical settings of a run; the defaults are the program's defaults.
struct NumericalSettings {
  int order = 16;                         ///< p
  int time_order = 1;                     ///< order of a step in dt, 1 … highest_time_order
  int upsampling = 2;                     ///< nonlinear terms live on the grid of order upsampling * p
  int longitude_fold = 1;                 ///< every grid is its own image under turns by 2π/fold about z
  double quadrature_oversampling = 1.15;  ///< nodes of the singular quadrature in θ per degree
  double quadrature_tolerance = 1e-4;     ///< of LayerCheck::error, above which finer quadrature is taken
  double flow_tolerance = 1e-9;           ///< of the tension and velocity solves
  double electric_tolerance = 1e-10;      ///< of the charge-density and charging solves
  double constraint_tolerance = 1e-9;     ///< of area and volume, relative, at the end of a step
  double curvature_tolerance = 1e-5;      ///< of Eq. (28), relative to the step's own curvature change
  double strain_tolerance = 1e-6;         ///< of the resolved local strain
};

/// Tables that depend on the settings and the symmetry alone, shared by all steps of a run. Immutable.
class Discretisation {
 public:
  /// @param symmetry  of every state that will be stepped: only what it leaves independent is computed
  explicit Discretisation(const NumericalSettings& settings, const Symmetry& symmetry = {});
  ~Discretisation();

  [[nodiscard]] const NumericalSettings& settings() const;
  [[nodiscard]] const Symmetry& symmetry() const;
  [[nodiscard]] int order() const;
  /// Transform between degree p and the grid of order p with all its longitudes; it knows m = 0 and ±1 alone where the
  /// symmetry leaves no others.
  [[nodiscard]] const SphereTransform& transform() const;
  /// Transform between degree p and the upsampled grid; of axisymmetric fields it sees four longitudes.
  [[nodiscard]] const SphereTransform& fine_transform() const;

  struct Tables;
  [[nodiscard]] const Tables& tables() const { return *tables_; }

 private:
  std::unique_ptr<const Tables> tables_;
};

}  // namespace vehd
