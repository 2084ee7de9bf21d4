#pragma once

#include <vector>

#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// The 27-node hexahedra that a file stores instead of the exact map: quadratic in each unit coordinate, interpolating
/// the map at the vertices and the midpoints of edges, faces and cells. Uses the other mesh for directions only.
/// Accuracy: exact at the nodes; volume and area as gmsh finds them in the file (tests/meshes/msh_file_test.cpp)
class SecondOrderMesh final : public VolumeMesh {
 public:
  /// @param exact  hexahedra, which must outlive this mesh
  /// @throws std::invalid_argument for tetrahedra, which are of second order themselves
  explicit SecondOrderMesh(const VolumeMesh& exact);

  [[nodiscard]] Point physical(int cell, const Point& unit) const override;
  [[nodiscard]] std::vector<Point> physical_points(int cell, const std::vector<Point>& units) const override;
  [[nodiscard]] Matrix3 jacobian(int cell, const Point& unit) const override;
  [[nodiscard]] Point direction(int cell, const Point& unit) const override { return exact_.direction(cell, unit); }

 private:
  using Nodes = Eigen::Matrix<double, 3, 27>;  // x fastest

  const VolumeMesh& exact_;
  std::vector<Nodes> nodes_;
};

}  // namespace vehd::meshes
