#pragma once

#include "bie/scene/scene.hpp"

namespace vehd::testing {

/// Factors that convert numbers of one unit system to another.
struct UnitFactors {
  double length = 1.0, time = 1.0, viscosity = 1.0, potential = 1.0;

  /// Factor of a quantity with these powers of length, time, viscosity and potential.
  [[nodiscard]] double of(int lengths, int times, int viscosities, int potentials) const;
};

/// The scene with the same physics in other units: every key with a dimension is multiplied by its factor.
Scene in_units(Scene scene, const UnitFactors& factors);

}  // namespace vehd::testing
