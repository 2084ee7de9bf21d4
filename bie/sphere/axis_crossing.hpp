#pragma once

#include "bie/sphere/neighbourhood.hpp"

namespace vehd {

/// Where the half line from a point along +z leaves a surface: by Newton's method from the highest of the nodes near
/// it. The place does not depend on how the surface is parametrised. Where no node lies above the point, the one
/// nearest to the line is taken for a start, and where Newton's method fails, its last point.
/// @param nodes         x at the nodes of the grid, [n_points x 3]
/// @param coefficients  of x
SpherePoint crossing_above(const Vector3& point, const SphereGrid& grid, const Matrix& nodes,
                           const Matrix& coefficients);

}  // namespace vehd
