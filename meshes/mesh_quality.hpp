#pragma once

#include <vector>

#include "meshes/frozen_shape.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// Volume and area of one vesicle in a mesh.
struct VesicleMeasures {
  double volume = 0.0;        ///< of the inside
  double area = 0.0;          ///< of its membrane faces
  double volume_error = 0.0;  ///< relative to the exact volume of the shape, signed
  double area_error = 0.0;
};

/// Quality measures of a mesh, computed on its curved map at the vertices and at Gauss points.
struct MeshQuality {
  double smallest_scaled_jacobian = 1.0;  ///< 1 for a cube or a regular tetrahedron, ≤ 0 if inverted
  int worst_cell = -1;
  Region worst_region = Region::inside;
  Point worst_position = Point::Zero();
  std::vector<double> scaled_jacobian;  ///< smallest value in each cell

  double smallest_size = 0.0;  ///< cube root of the smallest and of the largest cell volume
  double largest_size = 0.0;

  // Sums over all vesicles.
  double volume_inside = 0.0;  ///< of the mesh
  double area = 0.0;           ///< of its membrane faces
  double volume_error = 0.0;   ///< relative to the exact volumes of the shapes, signed
  double area_error = 0.0;
  std::vector<VesicleMeasures> vesicles;
};

/// @param shapes   the shapes of its vesicles
/// @param n_gauss  points per direction of the quadrature that gives volume and area
/// Accuracy: volume and area of a fine block mesh to 2e-6 (tests/meshes/block_mesh_test.cpp)
MeshQuality quality(const VolumeMesh& mesh, const std::vector<FrozenShape>& shapes, int n_gauss = 4);
MeshQuality quality(const VolumeMesh& mesh, const FrozenShape& shape, int n_gauss = 4);

/// @throws MeshError naming position, region, value and threshold if a cell is below the threshold
void require_quality(const MeshQuality& quality, double smallest_scaled_jacobian);

}  // namespace vehd::meshes
