#pragma once

#include <mutex>

#include "bie/physics/membrane.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/instruments.hpp"

namespace vehd::python {

/// A frozen surface of one degree with the operators that have been requested. Every one is assembled once.
class SurfaceObject {
 public:
  /// How fine it is.
  struct ResolutionLevel {
    int upsampling = 2;                     ///< its grid is that of degree upsampling * p
    double quadrature_oversampling = 1.15;  ///< nodes of the singular quadrature in θ per degree
  };

  /// @param position  coefficients of x, [n_coefficients x 3]
  /// @throws ShapeError if that is no field of a degree from lowest_order to highest_order
  /// @throws InputError if x_θ × x_φ does not point outwards
  SurfaceObject(Matrix position, const ResolutionLevel& level);

  [[nodiscard]] int order() const { return space_.order(); }
  /// Coefficients of x.
  [[nodiscard]] const Matrix& coefficients() const { return position_; }
  /// Between the degree and the grid of the surface.
  [[nodiscard]] const SphereTransform& transform() const { return membrane_.fine; }
  [[nodiscard]] const Surface& geometry() const { return membrane_.surface; }
  /// These operators at least, plain or weighted as the selection says.
  [[nodiscard]] const LayerOperators& operators(const LayerSelection& selection);
  /// The membrane with these weighted operators at least.
  [[nodiscard]] const Membrane& with(const LayerSelection& selection);

 private:
  Matrix position_;
  MembraneSpace space_;
  Instruments instruments_;
  Membrane membrane_;
  LayerOperators plain_;
  std::mutex mutex_;  // operators are assembled while other threads of Python run
};

/// Settings of a degree and a level. @throws ShapeError if the degree is out of range
NumericalSettings settings_of(const Matrix& position, const SurfaceObject::ResolutionLevel& level);

}  // namespace vehd::python
