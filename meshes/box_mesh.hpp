#pragma once

#include <array>
#include <memory>
#include <vector>

#include "meshes/box_map.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// Cells and radii of a mesh about two membranes, or of its half about one membrane beside a wall.
struct BoxMeshOptions {
  int cells_per_edge = 3;                  ///< of each of the 6 blocks that divide a membrane; also in the cores
  int blend_layers = 1;                    ///< between core and membrane
  int box_layers = 2;                      ///< between a membrane and its box
  int outer_layers = 2;                    ///< between the boxes and the outer sphere
  double box_growth = 2.0;                 ///< thickness of a layer over that of the one nearer to the membrane
  double outer_growth = 2.0;               ///< the same between boxes and sphere
  BoxOptions boxes;                        ///< geometry of the blocks
  double smallest_scaled_jacobian = 0.02;  ///< below this an element is too flat
};

/// Hexahedra in 36 blocks about two membranes, or in 18 about one membrane beside a wall (BoxMap). The interface is
/// split. Topology vertices are positions in space.
class BoxMesh final : public VolumeMesh {
 public:
  /// Part of a block that a cell fills, in the coordinates of BoxMap.
  struct CellPlace {
    BoxBlock block;
    Point low, high;
  };

  BoxMesh(MeshTopology topology, std::vector<CellPlace> places, std::shared_ptr<const BoxMap> map, double outer_radius,
          const std::optional<Wall>& wall);

  [[nodiscard]] Point physical(int cell, const Point& unit) const override;
  [[nodiscard]] std::vector<Point> physical_points(int cell, const std::vector<Point>& units) const override;
  [[nodiscard]] Matrix3 jacobian(int cell, const Point& unit) const override;
  [[nodiscard]] Point direction(int cell, const Point& unit) const override;

 private:
  [[nodiscard]] Point in_block(int cell, const Point& unit) const;

  std::vector<CellPlace> places_;
  std::shared_ptr<const BoxMap> map_;
};

/// @throws MeshError if no plane separates the shapes, if the outer sphere does not enclose the boxes about them, or if
/// an
///         element is inverted or too flat
/// @throws std::invalid_argument if an option is out of range
/// Accuracy: points of membranes and outer sphere to 1e-13, neighbouring cells meet to 1e-13
/// (tests/meshes/two_vesicle_mesh_test.cpp)
BoxMesh make_two_vesicle_mesh(const std::array<FrozenShape, 2>& shapes, const BoxMeshOptions& options = {});

/// @throws MeshError if the shape crosses the wall, if the outer sphere does not enclose the boxes, or if an element is
///         inverted or too flat
/// @throws std::invalid_argument if an option is out of range
/// Accuracy: as make_two_vesicle_mesh, also on the wall (tests/meshes/wall_mesh_test.cpp)
BoxMesh make_mesh_beside_wall(const FrozenShape& shape, const Wall& wall, const BoxMeshOptions& options = {});

/// A mesh whose nodes on the membrane have the directions r̂ of those of the mesh about `like`.
/// @param like  of which the shape is a deformation without a large rotation
BoxMesh make_mesh_beside_wall(const FrozenShape& shape, const FrozenShape& like, const Wall& wall,
                              const BoxMeshOptions& options);

}  // namespace vehd::meshes
