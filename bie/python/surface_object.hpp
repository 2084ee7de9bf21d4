#pragma once

#include <mutex>

#include "bie/physics/membrane.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/instruments.hpp"

namespace vehd::python {

/// A frozen surface of one degree with the operators that have been asked for. Every one is assembled once.
class SurfaceObject {
 public:
  /// How fine it is.
  struct Fineness {
    int upsampling = 2;                     ///< its grid is that of degree upsampling * p
    double quadrature_oversampling = 1.15;  ///< nodes of the singular quadrature in θ per degree
  };

  /// @param position  coefficients of x, [n_coefficients x 3]
  /// @throws ShapeError if that is no field of a degree from lowest_order to highest_order
  SurfaceObject(Matrix position, const Fineness& fineness);

  [[nodiscard]] int order() const { return space_.order(); }
  /// Coefficients of x.
  [[nodiscard]] const Matrix& coefficients() const { return position_; }
  /// Between the degree and the grid of the surface.
  [[nodiscard]] const SphereTransform& transform() const { return membrane_.fine; }
  [[nodiscard]] const Surface& geometry() const { return membrane_.surface; }
  /// The membrane with these operators at least; those of the Stokes double layer for equal viscosities.
  [[nodiscard]] const Membrane& with(const LayerSelection& selection);
  /// Coefficients of J f from those of f.
  [[nodiscard]] Matrix weighted(const Matrix& coefficients) const;
  /// Coefficients of f from those of J f.
  [[nodiscard]] Matrix unweighted(const Matrix& coefficients) const;

 private:
  Matrix position_;
  MembraneSpace space_;
  Instruments instruments_;
  Membrane membrane_;
  std::mutex mutex_;  // operators are assembled while other threads of Python run
};

/// Settings of a degree and a fineness. @throws ShapeError if the degree is out of range
NumericalSettings settings_of(const Matrix& position, const SurfaceObject::Fineness& fineness);

}  // namespace vehd::python
