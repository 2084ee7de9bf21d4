#pragma once

#include "bie/physics/membrane.hpp"

namespace vehd {

/// Errors of the discretised layers for densities whose potential is known.
struct LayerCheck {
  /// Largest of |S[n]|/radius, which is zero on a closed surface because n drives no incompressible flow, and of
  /// |D[1] + ½|; only of the layers that are assembled, 0 without any.
  double error = 0.0;
  /// Part of |S[n]|/radius due to the degrees of J n above p, estimated from their size and the order of S. Finer
  /// quadrature does not reduce it.
  double truncation = 0.0;
};

/// Checks the layers that the membrane has.
/// Accuracy: below 1e-6 for accurate layers on an asymmetric shape at p = 12, above 1e-5 at half the quadrature
/// (tests/stepping/evaluation/operator_checks_test.cpp)
/// Source: Gauss's theorem; Pozrikidis 1992
LayerCheck check_layers(const Membrane& membrane);

/// Least distance of two parts of the membrane that face each other, in grid spacings: over pairs of nodes of order p,
/// poles included, with n_i·n_j < −½ that lie within one spacing of each other's normal line, the distance along the
/// normals over the spacing √(4π J/N). Below 1 the grid does not resolve them as two; infinite if no node faces
/// another.
/// @param nodes     of order p and all longitudes
/// @param position  coefficients of x, [n_coefficients x 3]
/// @param one_meridian_suffices  true if every meridian is an image of the first
/// Accuracy: the distance of the parts of a dimpled disc to 5 % below and 0.15 spacings above
/// (tests/stepping/evaluation/operator_checks_test.cpp)
double separation(const SphereTransform& nodes, const Matrix& position, bool one_meridian_suffices);

/// Rejects a step that brings two parts of a membrane into contact, or so much nearer at once that they could have
/// passed through each other.
/// @param before  their separation() at its start
/// @throws ConvergenceError for such a step
void require_apart(double separation, double before);

}  // namespace vehd
