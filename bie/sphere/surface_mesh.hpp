#pragma once

#include <cstdint>
#include <vector>

#include "bie/sphere/grid.hpp"

/// Closed triangulation of the membrane for viewers. The grid has no pole nodes, so two points are added after the
/// grid's: north pole, then south pole.
namespace vehd {

/// Values of a field on the grid and then at both poles, [n_points + 2 x n_fields].
Matrix with_poles(const Matrix& grid_values, const Matrix& coefficients);

/// Point indices, three per triangle, outward orientation; azimuth closed, a fan at either pole.
/// Two triangles traverse every edge, in opposite directions (tests/sphere/surface_mesh_test.cpp).
std::vector<std::int64_t> closed_triangles(const SphereGrid& grid);

}  // namespace vehd
