#include "bie/python/layer_matrix.hpp"

#include <numeric>
#include <utility>
#include <vector>

#include "bie/physics/electric.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {
namespace {

LayerSelection selection_of(Layer layer) {
  switch (layer) {
    case Layer::single:
    case Layer::hypersingular:
      return {.laplace_single = true};
    case Layer::double_layer:
      return {.laplace_double = true};
    case Layer::adjoint:
      return {.laplace_adjoint = true};
    case Layer::stokes_single:
      return {.stokes_single = true};
    case Layer::stokes_double:
      break;
  }
  return {.stokes_double = true};
}

}  // namespace

LayerMatrix::LayerMatrix(std::shared_ptr<SurfaceObject> surface, Layer layer)
    : surface_(std::move(surface)), layer_(layer), membrane_(surface_->with(selection_of(layer))) {}

Index LayerMatrix::size() const { return surface_->coefficients().rows() * (is_stokes() ? 3 : 1); }

Matrix LayerMatrix::apply(const Matrix& density) const {
  require_size("density", density.rows(), size());
  return is_stokes() ? apply_stokes(density) : apply_scalar(density);
}

Matrix LayerMatrix::apply_scalar(const Matrix& density) const {
  const LayerOperators& layers = membrane_.layers;
  if (layer_ == Layer::single) return layers.laplace_single.apply(surface_->weighted(density));
  if (layer_ == Layer::double_layer) return layers.laplace_double.apply(density);
  if (layer_ == Layer::adjoint) {
    return surface_->unweighted(layers.laplace_adjoint.apply(surface_->weighted(density)));
  }
  Matrix result(density.rows(), density.cols());
  for (Index i = 0; i < density.cols(); ++i) {
    const Vector values = weighted_hypersingular(membrane_, density.col(i));
    result.col(i) = membrane_.fine.analyze(values.cwiseQuotient(membrane_.surface.area_element));
  }
  return result;
}

Matrix LayerMatrix::apply_stokes(const Matrix& density) const {
  const Index n = surface_->coefficients().rows();
  Matrix result(density.rows(), density.cols());
  for (Index i = 0; i < density.cols(); ++i) {
    const Vector column = density.col(i);
    const Matrix field = Eigen::Map<const Matrix>(column.data(), n, 3);
    const Matrix velocity = layer_ == Layer::stokes_single
                                ? membrane_.layers.stokes_single.apply(surface_->weighted(field))
                                : membrane_.layers.stokes_double.apply(field);
    result.col(i) = Eigen::Map<const Vector>(velocity.data(), velocity.size());
  }
  return result;
}

Matrix LayerMatrix::matrix() const {
  if (!is_stokes()) return apply_scalar(Matrix::Identity(size(), size()));
  const Index n = surface_->coefficients().rows();
  std::vector<Index> entries(static_cast<std::size_t>(size()));
  std::iota(entries.begin(), entries.end(), Index{0});
  if (layer_ == Layer::stokes_double) return membrane_.layers.stokes_double.between(n, entries);
  Matrix result = membrane_.layers.stokes_single.between(n, entries);
  const Matrix weights = surface_->weighted(Matrix::Identity(n, n));
  for (Index component = 0; component < 3; ++component) {
    const Matrix block = result.middleCols(component * n, n) * weights;
    result.middleCols(component * n, n) = block;
  }
  return result;
}

}  // namespace vehd::python
