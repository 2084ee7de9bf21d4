#include "bie/python/surface_object.hpp"

#include <fmt/format.h>

#include <utility>

#include "bie/sphere/degrees.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/space/membrane_at.hpp"
#include "bie/support/errors.hpp"

namespace vehd::python {

NumericalSettings settings_of(const Matrix& position, const SurfaceObject::Fineness& fineness) {
  require_size("position (columns)", position.cols(), 3);
  NumericalSettings settings;
  settings.order = order_of(position.rows());
  if (settings.order < lowest_order || settings.order > highest_order) {
    throw ShapeError(
        fmt::format("a surface of degree {}; accepted: {} ... {}", settings.order, lowest_order, highest_order));
  }
  settings.upsampling = fineness.upsampling;
  settings.quadrature_oversampling = fineness.quadrature_oversampling;
  return settings;
}

SurfaceObject::SurfaceObject(Matrix position, const Fineness& fineness)
    : position_(std::move(position)),
      space_(settings_of(position_, fineness), {}),
      membrane_(membrane_at(space_, position_, {}, 1.0, instruments_)) {}

const Membrane& SurfaceObject::with(const LayerSelection& selection) {
  const std::lock_guard lock(mutex_);
  LayerOperators& layers = membrane_.layers;
  const LayerSelection missing{
      .laplace_single = selection.laplace_single && layers.laplace_single.empty(),
      .laplace_double = selection.laplace_double && layers.laplace_double.empty(),
      .laplace_adjoint = selection.laplace_adjoint && layers.laplace_adjoint.empty(),
      .stokes_single = selection.stokes_single && layers.stokes_single.empty(),
      .stokes_double = selection.stokes_double && layers.stokes_double.empty(),
  };
  if (!missing.laplace_single && !missing.laplace_double && !missing.laplace_adjoint && !missing.stokes_single &&
      !missing.stokes_double) {
    return membrane_;
  }
  LayerOperators made = assemble_symmetric_operators(space_.quadrature(), space_.targets(), position_, missing,
                                                     instruments_, space_.subspace(), space_.fold());
  if (missing.laplace_single) layers.laplace_single = std::move(made.laplace_single);
  if (missing.laplace_double) layers.laplace_double = std::move(made.laplace_double);
  if (missing.laplace_adjoint) layers.laplace_adjoint = std::move(made.laplace_adjoint);
  if (missing.stokes_single) layers.stokes_single = std::move(made.stokes_single);
  if (missing.stokes_double) layers.stokes_double = std::move(made.stokes_double);
  return membrane_;
}

Matrix SurfaceObject::weighted(const Matrix& coefficients) const {
  return membrane_.weighted(transform().synthesize(coefficients));
}

Matrix SurfaceObject::unweighted(const Matrix& coefficients) const {
  const Vector inverse = geometry().area_element.cwiseInverse();
  return transform().analyze(inverse.asDiagonal() * transform().synthesize(coefficients));
}

}  // namespace vehd::python
