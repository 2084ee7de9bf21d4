#pragma once

#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Where a field is largest, and how large.
struct Top {
  SpherePoint point;
  double value = 0.0;
};

/// The top of sign · f, with the arguments of `maximum`. Of several that are equal to rounding it may be any.
/// @param coefficients  of f, [n_coefficients]
Top top_of(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
           double sign);

/// Maximum of sign · f over the sphere, by Newton's method on the field from the largest node, and from up to three
/// others whose parabolas promise most. Never above the true maximum; at rounding where the grid sees the highest top,
/// be it a point or a ring, and else not below the largest node.
/// @param nodes   fields on the grid with their Hessians, each [n_points x n_fields]
/// @param column  of f among them
/// @param coefficients  of f, [n_coefficients]
/// @param sign          1 for the maximum, −1 for minus the minimum
/// @return              in the units of f
/// Accuracy: a ring and a pole to 1e-14, a field on any grid to 1e-13 (tests/sphere/maximum_test.cpp)
double maximum(const SphereGrid& grid, const SphereDerivatives& nodes, Index column, const Vector& coefficients,
               double sign);

}  // namespace vehd
