#pragma once

#include <optional>

#include "bie/sphere/neighbourhood.hpp"
#include "bie/sphere/transform.hpp"

namespace vehd {

/// Where a surface lies highest on the line through a point along z: the outermost of its crossings along +z. The line
/// counts on both sides of the point, so that nothing jumps where the surface passes through the point; a membrane that
/// opens upwards is read at the floor of its hollow if the line crosses nothing above that. Neither the parametrisation
/// nor the grid decides which crossing is found: patches around all nodes and both poles are searched, each until it
/// cannot hold a crossing or Newton's method must find the only one. Two crossings that are about to merge may count as
/// none once they are closer than a fiftieth of the distance of nodes.
/// @param grid          of the nodes, with the longitudes of make_grid(p)
/// @param nodes         x at the nodes of the grid, with its Hessian, each [n_points x 3]
/// @param coefficients  of x, [n_coefficients x 3]
/// @returns             nothing where the line misses the surface
/// Accuracy: rounding; heights of ellipsoids to 1e-13, whatever the parametrisation to 1e-12
/// (tests/sphere/axis_crossing_test.cpp)
std::optional<SpherePoint> highest_on_line(const Vector3& point, const SphereGrid& grid, const SphereDerivatives& nodes,
                                           const Matrix& coefficients);

/// The pole of larger z: highest_on_line of a surface that is axisymmetric about z, for a point of its axis.
/// @param coefficients  of x, [n_coefficients x 3]
/// Accuracy: rounding (tests/sphere/axis_crossing_test.cpp)
SpherePoint higher_pole(const Matrix& coefficients);

}  // namespace vehd
