#include "bie/python/layer_matrix.hpp"

#include <numeric>
#include <utility>
#include <vector>

#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

LayerSelection selection_of(Layer layer) {
  switch (layer) {
    case Layer::single:
      return {.laplace_single = true};
    case Layer::double_layer:
      return {.laplace_double = true};
    case Layer::adjoint:
      return {.laplace_adjoint = true};
    case Layer::hypersingular:
      return {.laplace_hypersingular = true};
    case Layer::stokes_single:
      return {.stokes_single = true};
    case Layer::stokes_double:
      break;
  }
  return {.stokes_double = true};
}

/// Null for Stokes layers.
const ScalarOperator* scalar_of(const LayerOperators& layers, Layer layer) {
  switch (layer) {
    case Layer::single:
      return &layers.laplace_single;
    case Layer::double_layer:
      return &layers.laplace_double;
    case Layer::adjoint:
      return &layers.laplace_adjoint;
    case Layer::hypersingular:
      return &layers.laplace_hypersingular;
    default:
      return nullptr;
  }
}

}  // namespace

LayerMatrix::LayerMatrix(std::shared_ptr<SurfaceObject> surface, Layer layer, bool weighted)
    : surface_(std::move(surface)), n_(surface_->coefficients().rows()) {
  LayerSelection selection = selection_of(layer);
  selection.plain = !weighted;
  const LayerOperators& layers = surface_->operators(selection);
  scalar_ = scalar_of(layers, layer);
  stokes_ = layer == Layer::stokes_single ? &layers.stokes_single : &layers.stokes_double;
}

Index LayerMatrix::size() const { return scalar_ != nullptr ? n_ : 3 * n_; }

Matrix LayerMatrix::apply(const Matrix& density) const {
  require_size("density", density.rows(), size());
  if (scalar_ != nullptr) return scalar_->apply(density);
  Matrix result(density.rows(), density.cols());
  for (Index i = 0; i < density.cols(); ++i) {
    const Vector column = density.col(i);
    const Matrix velocity = stokes_->apply(column.reshaped(n_, 3));
    result.col(i) = velocity.reshaped();
  }
  return result;
}

Matrix LayerMatrix::matrix() const {
  if (scalar_ != nullptr) return scalar_->apply(Matrix::Identity(size(), size()));
  std::vector<Index> entries(static_cast<std::size_t>(size()));
  std::iota(entries.begin(), entries.end(), Index{0});
  return stokes_->between(n_, entries);
}

}  // namespace vehd::python
