#include "bie/stepping/discretisation.hpp"

#include "bie/geometry/surface.hpp"
#include "bie/stepping/discretisation_tables.hpp"

namespace vehd {

namespace {

/// Cartesian components of axisymmetric vectors have the modes m = 0 and ±1 only.
SphereTransform transform_for(const Symmetry& symmetry, int order, int grid_order) {
  if (symmetry.axisymmetric) return {order, make_grid(grid_order, 4), 1};
  return {order, make_grid(grid_order)};
}

}  // namespace

Discretisation::Tables::Tables(const NumericalSettings& settings_, const Symmetry& symmetry_)
    : settings(settings_),
      symmetry(symmetry_),
      output(settings.order, make_grid(settings.order)),
      targets(transform_for(symmetry, settings.order, settings.order)),
      fine(transform_for(symmetry, settings.order, settings.upsampling * settings.order)),
      quadrature(make_rotated_quadrature(targets.grid(), settings.quadrature_oversampling)) {}

Discretisation::Discretisation(const NumericalSettings& settings, const Symmetry& symmetry)
    : tables_(std::make_unique<const Tables>(settings, symmetry)) {}
Discretisation::~Discretisation() = default;

const NumericalSettings& Discretisation::settings() const { return tables_->settings; }
const Symmetry& Discretisation::symmetry() const { return tables_->symmetry; }
int Discretisation::order() const { return tables_->settings.order; }
const SphereTransform& Discretisation::transform() const { return tables_->output; }
const SphereTransform& Discretisation::fine_transform() const { return tables_->fine; }

Vector area_element(const Discretisation& discretisation, const Matrix& position) {
  return make_surface(discretisation.transform(), position).area_element;
}

}  // namespace vehd
