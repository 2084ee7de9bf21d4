#pragma once

#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/stepping/discretisation.hpp"

namespace vehd {

struct Discretisation::Tables {
  NumericalSettings settings;
  Symmetry symmetry;
  SphereTransform output;   ///< degree p ↔ grid of order p
  SphereTransform targets;  ///< the same on the longitudes that the symmetry leaves
  SphereTransform fine;     ///< degree p ↔ upsampled grid, likewise
  RotatedQuadrature quadrature;

  Tables(const NumericalSettings& settings, const Symmetry& symmetry);
};

}  // namespace vehd
