#include "bie/stepping/membrane_at.hpp"

#include <cmath>
#include <numbers>

#include "bie/stepping/discretisation_tables.hpp"

namespace vehd {

Membrane membrane_at(const Discretisation& discretisation, const Matrix& position, const LayerSelection& selection,
                     double viscosity_ratio, Instruments& instruments) {
  const Discretisation::Tables& tables = discretisation.tables();
  Surface surface = make_surface(tables.fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  LayerOperators layers = assemble_layer_operators(tables.quadrature, tables.targets, position, selection, instruments,
                                                   tables.symmetry.reflections, tables.fold);
  std::optional<ViscosityContrast> contrast;
  if (selection.stokes_double) {
    contrast.emplace(ViscosityContrastParameters{viscosity_ratio}, tables.fine, surface, layers.stokes_double,
                     tables.symmetry.reflections);
    layers.stokes_double = {};
  }
  return {tables.fine, std::move(surface), std::move(layers), radius, std::move(contrast)};
}

}  // namespace vehd
