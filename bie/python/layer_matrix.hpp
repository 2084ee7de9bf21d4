#pragma once

#include <memory>
#include <string>

#include "bie/python/surface_object.hpp"

namespace vehd::python {

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
  /// The matrix of `apply`, [size x size].
  [[nodiscard]] Matrix matrix() const;

 private:
  std::shared_ptr<SurfaceObject> surface_;
  Index n_;                       ///< coefficients of a scalar field
  const ScalarOperator* scalar_;  ///< or null
  const StokesOperator* stokes_;
};

}  // namespace vehd::python
