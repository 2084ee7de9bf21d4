#include "bie/python/surface_object.hpp"

#include <fmt/format.h>

#include <numeric>
#include <utility>
#include <vector>

#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/discretisation.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {

NumericalSettings settings_of(const Matrix& position, const SurfaceObject::ResolutionLevel& level) {
  require_size("position (columns)", position.cols(), 3);
  NumericalSettings settings;
  settings.order = order_of(position.rows());
  if (settings.order < lowest_order || settings.order > highest_order) {
    throw ShapeError(
        fmt::format("a surface of degree {}; accepted: {} ... {}", settings.order, lowest_order, highest_order));
  }
  settings.upsampling = level.upsampling;
  settings.quadrature_oversampling = level.quadrature_oversampling;
  return settings;
}

SurfaceObject::SurfaceObject(Matrix position, const ResolutionLevel& level)
    : position_(std::move(position)),
      space_(settings_of(position_, level), {}),
      membrane_(membrane_at(space_, position_, {}, 1.0, instruments_)) {
  // Squares of metrics overflow outside this range, which scenes also have.
  constexpr double kSmallest = 1e-30, kLargest = 1e30;
  if (!(membrane_.radius >= kSmallest && membrane_.radius <= kLargest)) {
    throw InputError(fmt::format("the surface has the radius √(area/4π) = {:.6g}; accepted: {:g} ... {:g}",
                                 membrane_.radius, kSmallest, kLargest));
  }
  const double volume = enclosed_volume(geometry());
  if (volume > 0.0) return;
  throw InputError(
      fmt::format("the surface encloses the volume {:.6g}; accepted: x(θ, φ) with x_θ × x_φ pointing outwards, hence a "
                  "volume above "
                  "0; negating the coefficients of m < 0 turns a surface inside out and keeps its shape",
                  volume));
}

const LayerOperators& SurfaceObject::operators(const LayerSelection& selection) {
  const std::lock_guard lock(mutex_);
  LayerOperators& layers = selection.plain ? plain_ : membrane_.layers;
  LayerSelection missing{.plain = selection.plain};
  bool any = false;
  const auto each = [&](const auto& visit) {
    visit(&LayerSelection::laplace_single, &LayerOperators::laplace_single);
    visit(&LayerSelection::laplace_double, &LayerOperators::laplace_double);
    visit(&LayerSelection::laplace_adjoint, &LayerOperators::laplace_adjoint);
    visit(&LayerSelection::laplace_hypersingular, &LayerOperators::laplace_hypersingular);
    visit(&LayerSelection::stokes_single, &LayerOperators::stokes_single);
    visit(&LayerSelection::stokes_double, &LayerOperators::stokes_double);
  };
  each([&](auto selected, auto layer) {
    missing.*selected = selection.*selected && (layers.*layer).empty();
    any = any || missing.*selected;
  });
  if (!any) return layers;
  LayerOperators made = assemble_symmetric_operators(space_.quadrature(), space_.targets(), position_, missing,
                                                     instruments_, space_.subspace(), space_.fold());
  each([&](auto selected, auto layer) {
    if (missing.*selected) layers.*layer = std::move(made.*layer);
  });
  return layers;
}

const Membrane& SurfaceObject::with(const LayerSelection& selection) {
  static_cast<void>(operators(selection));
  return membrane_;
}

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
