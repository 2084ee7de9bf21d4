#pragma once

#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/stepping/discretisation.hpp"

namespace vehd {

struct Discretisation::Tables {
  NumericalSettings settings;
  SphereTransform coarse;  ///< degree p ↔ grid of order p
  SphereTransform fine;    ///< degree p ↔ upsampled grid
  RotatedQuadrature quadrature;

  explicit Tables(const NumericalSettings& settings);
};

}  // namespace vehd
