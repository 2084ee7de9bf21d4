#pragma once

#include "bie/potentials/rotated_quadrature.hpp"
#include "bie/stepping/discretisation.hpp"

namespace vehd {

struct Discretisation::Tables {
  NumericalSettings settings;
  Symmetry symmetry;
  SphereTransform whole;    ///< degree p ↔ grid of order p with all longitudes
  SphereTransform targets;  ///< degree p ↔ grid of order p on the longitudes that the symmetry leaves
  SphereTransform fine;     ///< degree p ↔ upsampled grid, likewise
  RotatedQuadrature quadrature;
  std::vector<Index> even_scalars;  ///< even_coefficients of degree p
  int fold;                         ///< turns by 2π/fold about z take states and longitudes of targets to each other

  Tables(const NumericalSettings& settings, const Symmetry& symmetry);
};

}  // namespace vehd
