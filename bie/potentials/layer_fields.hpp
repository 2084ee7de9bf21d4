#pragma once

#include "bie/potentials/layer_sums.hpp"
#include "bie/support/types.hpp"

namespace vehd {

/// Densities as spherical-harmonic coefficients of the order of the surface; an empty one costs nothing.
struct LayerDensities {
  Vector laplace_single;   ///< J f, or f where `plain`, [n_coefficients]
  Vector laplace_double;   ///< f, [n_coefficients]
  Matrix stokes_single;    ///< likewise, [n_coefficients x 3]
  Matrix stokes_double;    ///< v, [n_coefficients x 3]
  bool gradients = false;  ///< of the Laplace layers
  bool plain = false;      ///< J is multiplied at the nodes, so that nothing of J f is cut to degree p
};

/// Position and densities side by side: what is rotated and synthesised together, and which node columns follow.
struct LayerFields {
  Matrix coefficients;  ///< [n_coefficients x fields], the position first
  /// First field of each density, −1 if absent.
  int single = -1, double_layer = -1, stokes = -1, stokes_double = -1;
  NodeColumns columns;
};

/// @throws ShapeError if a density does not match the order of the position
/// @param position  coefficients of x, [n_coefficients x 3]
LayerFields make_layer_fields(const Matrix& position, const LayerDensities& densities);

}  // namespace vehd
