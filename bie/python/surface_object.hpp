#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "bie/physics/membrane.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/instruments.hpp"

namespace vehd::python {

/// A frozen surface of one degree with the operators requested so far. Each operator is assembled once.
class SurfaceObject {
 public:
  /// Resolution of the grid and of the quadrature.
  struct ResolutionLevel {
    int upsampling = 2;                     ///< the grid is that of degree upsampling * p
    double quadrature_oversampling = 1.15;  ///< nodes of the singular quadrature in θ per degree
  };

  /// @param position  coefficients of x, [n_coefficients x 3]
  /// @throws ShapeError if it is not a field of a degree from lowest_order to highest_order
  /// @throws InputError if x_θ × x_φ does not point outwards
  SurfaceObject(Matrix position, const ResolutionLevel& level);

  [[nodiscard]] int order() const { return space_.order(); }
  /// Coefficients of x, [n_coefficients x 3].
  [[nodiscard]] const Matrix& coefficients() const { return position_; }
  /// Transform between the degree and the grid of the surface.
  [[nodiscard]] const SphereTransform& transform() const { return membrane_.fine; }
  [[nodiscard]] const Surface& geometry() const { return membrane_.surface; }
  /// At least these operators, plain or weighted as the selection says.
  [[nodiscard]] const LayerOperators& operators(const LayerSelection& selection);
  /// The membrane with at least these weighted operators.
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

/// The layer operators of a surface.
enum class Layer { single, double_layer, adjoint, hypersingular, stokes_single, stokes_double };

/// One layer operator from coefficients to coefficients of degree p, plain or weighted as in LayerOperators; principal
/// values. Vector densities of the Stokes layers are three scalars one after the other.
class LayerMatrix {
 public:
  LayerMatrix(std::shared_ptr<SurfaceObject> surface, Layer layer, bool weighted);

  /// Number of rows and of columns.
  [[nodiscard]] Index size() const;
  /// @param density  [size] or [size x n]
  /// @throws ShapeError
  [[nodiscard]] Matrix apply(const Matrix& density) const;
  /// Matrix of `apply`, [size x size].
  [[nodiscard]] Matrix matrix() const;

 private:
  std::shared_ptr<SurfaceObject> surface_;
  Index n_;                       ///< coefficients of a scalar field
  const ScalarOperator* scalar_;  ///< null for Stokes layers
  const StokesOperator* stokes_;
};

}  // namespace vehd::python
