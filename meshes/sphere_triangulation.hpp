#pragma once

#include <array>
#include <functional>
#include <vector>

#include "meshes/types.hpp"

namespace vehd::meshes {

/// Triangles of the unit sphere.
struct SphereTriangulation {
  std::vector<Point> directions;              ///< unit vectors
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// Unstructured triangulation of the unit sphere by gmsh with the given edge length at each direction.
/// @throws MeshError if the mesher fails
SphereTriangulation triangulate_sphere(const std::function<double(const Point& direction)>& edge_length);

}  // namespace vehd::meshes
