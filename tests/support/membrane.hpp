#pragma once

#include <numbers>

#include "bie/physics/membrane.hpp"
#include "tests/support/layers.hpp"
#include "tests/support/shapes.hpp"

namespace vehd::testing {

/// A frozen membrane on the tables of `space`.
/// @param viscosity_ratio  a value other than 1 requires the Stokes double layer of the selection
inline Membrane make_membrane(const Space& space, const Matrix& position, const LayerSelection& selection,
                              double viscosity_ratio = 1.0) {
  Surface surface = make_surface(space.fine, position);
  const double radius = std::sqrt(surface_area(surface) / (4.0 * std::numbers::pi));
  LayerOperators layers = assemble(space, position, selection);
  const SymmetrySubspace subspace({}, space.fine.order());
  std::optional<ViscosityContrast> contrast;
  if (viscosity_ratio != 1.0) {
    contrast.emplace(ViscosityContrastParameters{viscosity_ratio}, space.fine, surface, layers.stokes_double, subspace);
  }
  return {space.fine, std::move(surface), std::move(layers), radius, subspace, std::move(contrast)};
}

/// asymmetric_shape as a frozen membrane without layers.
struct AsymmetricMembrane {
  Space space;
  Matrix position;
  Membrane membrane;

  explicit AsymmetricMembrane(int order)
      : space(order), position(asymmetric_shape(order)), membrane(make_membrane(space, position, {})) {}
};

}  // namespace vehd::testing
