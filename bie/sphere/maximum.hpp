#pragma once

#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Point and value of the maximum of a field.
struct Top {
  SpherePoint point;
  double value = 0.0;
};

/// Point and value of the maximum of sign · f, arguments as in `maximum`; any of several that are equal to rounding.
/// @param coefficients  of f, [n_coefficients]
Top top_of(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
           double sign);

/// Maximum of sign · f over the sphere, by Newton's method from the largest node and from up to three others whose
/// parabolas predict the largest values. Never above the true maximum; accurate to rounding if the grid resolves the
/// highest maximum, be it a point or a ring; never below the largest nodal value.
/// @param nodes   fields on the grid with their Hessians, each [n_points x n_fields]
/// @param column  of f among them
/// @param coefficients  of f, [n_coefficients]
/// @param sign          1 for the maximum, −1 for minus the minimum
/// @return              in the units of f
/// Accuracy: a ring and a pole to 1e-14, a field on any grid to 1e-13 (tests/sphere/maximum_test.cpp)
double maximum(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
               double sign);

}  // namespace vehd
