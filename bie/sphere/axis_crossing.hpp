#pragma once

#include <optional>

#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Highest intersection of a surface with the line through a point along z. The line extends to both sides of the
/// point, so that the result does not jump when the surface passes through the point. On a membrane that opens upwards
/// the result is the floor of its hollow if the line crosses nothing above. The result depends neither on the
/// parametrisation nor on the grid: patches around all nodes and both poles are subdivided until a patch cannot contain
/// a crossing or Newton's method is certain to find its only one. Two crossings that are about to merge may be missed
/// once they are closer than a fiftieth of the node spacing.
/// @param grid          of the nodes, with the longitudes of make_grid(p)
/// @param nodes         x at the nodes of the grid, with its Hessian, each [n_points x 3]
/// @param coefficients  of x, [n_coefficients x 3]
/// @returns             nothing if the line misses the surface
/// Accuracy: rounding; heights of ellipsoids to 1e-13, whatever the parametrisation to 1e-12
/// (tests/sphere/axis_crossing_test.cpp)
std::optional<SpherePoint> highest_on_line(const Vector3& point, const SphereGrid& grid, const SphereDerivatives& nodes,
                                           const Matrix& coefficients);

/// The pole of larger z: highest_on_line of a surface that is axisymmetric about z, for a point on its axis.
/// @param coefficients  of x, [n_coefficients x 3]
/// Accuracy: rounding (tests/sphere/axis_crossing_test.cpp)
SpherePoint higher_pole(const Matrix& coefficients);

}  // namespace vehd
