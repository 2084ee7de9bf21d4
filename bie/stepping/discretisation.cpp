#include "bie/stepping/discretisation.hpp"

#include <numeric>

#include "bie/stepping/discretisation_tables.hpp"

namespace vehd {

namespace {

/// The least even number of longitudes that integrates products of harmonics and that the turns map onto itself.
int n_longitudes(int grid_order, int fold) {
  const int step = std::lcm(2, fold);
  return step * ((2 * grid_order + 2 + step - 1) / step);
}

/// Cartesian components of axisymmetric vectors have the modes m = 0 and ±1 only.
SphereTransform transform_for(const Symmetry& symmetry, const NumericalSettings& settings, int grid_order) {
  if (symmetry.axisymmetric) return {settings.order, make_grid(grid_order, 4), 1};
  const int fold = std::lcm(symmetry.fold, settings.longitude_fold);
  return {settings.order, make_grid(grid_order, n_longitudes(grid_order, fold))};
}

}  // namespace

Discretisation::Tables::Tables(const NumericalSettings& settings_, const Symmetry& symmetry_)
    : settings(settings_),
      symmetry(symmetry_),
      whole(settings.order, make_grid(settings.order), symmetry.axisymmetric ? 1 : settings.order),
      targets(transform_for(symmetry, settings, settings.order)),
      fine(transform_for(symmetry, settings, settings.upsampling * settings.order)),
      quadrature(make_rotated_quadrature(targets.grid(), settings.quadrature_oversampling)),
      even_scalars(even_coefficients(symmetry, settings.order)),
      fold(symmetry.axisymmetric ? targets.grid().n_phi : symmetry.fold) {}

Discretisation::Discretisation(const NumericalSettings& settings, const Symmetry& symmetry)
    : tables_(std::make_unique<const Tables>(settings, symmetry)) {}
Discretisation::~Discretisation() = default;

const NumericalSettings& Discretisation::settings() const { return tables_->settings; }
const Symmetry& Discretisation::symmetry() const { return tables_->symmetry; }
int Discretisation::order() const { return tables_->settings.order; }
const SphereTransform& Discretisation::transform() const { return tables_->whole; }
const SphereTransform& Discretisation::fine_transform() const { return tables_->fine; }

}  // namespace vehd
