#pragma once

#include <array>
#include <functional>
#include <vector>

#include "meshes/types.hpp"

namespace vehd::meshes {

/// A closed surface of flat triangles.
struct ClosedSurface {
  std::vector<Point> vertices;
  std::vector<std::array<int, 3>> triangles;  ///< counter-clockwise from outside
};

/// Tetrahedra that fill a closed surface and the shell between it and another one. Vertices: those of the inner surface
/// in their order, those of the outer one, then new ones.
struct FilledVolumes {
  std::vector<Point> vertices;
  std::vector<std::array<int, 4>> inside;
  std::vector<std::array<int, 4>> shell;
};

/// Meshes both volumes; the triangles of the surfaces are preserved.
/// @throws MeshError if neither of gmsh's algorithms Delaunay and HXT fills both volumes
FilledVolumes fill_with_tetrahedra(const ClosedSurface& inner, const ClosedSurface& outer,
                                   const std::function<double(const Point& position)>& edge_length);

}  // namespace vehd::meshes
