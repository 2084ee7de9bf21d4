#include "bie/stepping/discretisation.hpp"

#include "bie/geometry/surface.hpp"
#include "bie/stepping/discretisation_tables.hpp"

namespace vehd {

Discretisation::Tables::Tables(const NumericalSettings& settings_)
    : settings(settings_),
      coarse(settings.order, make_grid(settings.order)),
      fine(settings.order, make_grid(settings.upsampling * settings.order)),
      quadrature(make_rotated_quadrature(coarse.grid(), settings.quadrature_oversampling)) {}

Discretisation::Discretisation(const NumericalSettings& settings) : tables_(std::make_unique<const Tables>(settings)) {}
Discretisation::~Discretisation() = default;

const NumericalSettings& Discretisation::settings() const { return tables_->settings; }
int Discretisation::order() const { return tables_->settings.order; }
const SphereTransform& Discretisation::transform() const { return tables_->coarse; }
const SphereTransform& Discretisation::fine_transform() const { return tables_->fine; }

Vector area_element(const Discretisation& discretisation, const Matrix& position) {
  return make_surface(discretisation.transform(), position).area_element;
}

}  // namespace vehd
