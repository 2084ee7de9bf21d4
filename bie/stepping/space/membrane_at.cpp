#include "bie/stepping/space/membrane_at.hpp"

#include <cmath>
#include <numbers>

namespace vehd {

Membrane membrane_at(const MembraneSpace& space, const Matrix& position, const LayerSelection& selection,
                     double viscosity_ratio, Instruments& instruments) {
  const SymmetrySubspace& subspace = space.subspace();
  Surface surface = make_surface(space.fine_transform(), position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  LayerOperators layers = assemble_symmetric_operators(space.quadrature(), space.targets(), position, selection,
                                                       instruments, subspace, space.fold());
  std::optional<ViscosityContrast> contrast;
  if (selection.stokes_double) {
    contrast.emplace(ViscosityContrastParameters{viscosity_ratio}, space.fine_transform(), surface,
                     layers.stokes_double, subspace);
    layers.stokes_double = {};
  }
  return {space.fine_transform(), std::move(surface), std::move(layers), radius, subspace, std::move(contrast)};
}

MembraneMaterial material_at(const MembraneSpace& space, const MembraneMaterial& coefficients) {
  MembraneMaterial values = coefficients;
  for_each_property(values, [&](Vector& property) { property = Vector(space.fine_transform().synthesize(property)); });
  return values;
}

}  // namespace vehd
