#pragma once

#include <memory>
#include <string>

#include "bie/python/surface_object.hpp"

namespace vehd::python {

/// The layer operators of a surface.
enum class Layer { single, double_layer, adjoint, hypersingular, stokes_single, stokes_double };

/// One layer operator on plain densities, from coefficients to coefficients of degree p; principal values. Vector
/// densities of the Stokes layers are three scalars one after the other.
class LayerMatrix {
 public:
  LayerMatrix(std::shared_ptr<SurfaceObject> surface, Layer layer);

  /// Number of rows and of columns.
  [[nodiscard]] Index size() const;
  /// @param density  [size] or [size x n]
  /// @throws ShapeError
  [[nodiscard]] Matrix apply(const Matrix& density) const;
  /// What `apply` does, as a matrix, [size x size].
  [[nodiscard]] Matrix matrix() const;

 private:
  [[nodiscard]] bool is_stokes() const { return layer_ == Layer::stokes_single || layer_ == Layer::stokes_double; }
  [[nodiscard]] Matrix apply_scalar(const Matrix& density) const;
  [[nodiscard]] Matrix apply_stokes(const Matrix& density) const;

  std::shared_ptr<SurfaceObject> surface_;
  Layer layer_;
  const Membrane& membrane_;
};

}  // namespace vehd::python
