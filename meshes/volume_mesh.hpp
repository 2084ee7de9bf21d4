#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "meshes/block.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/mesh_topology.hpp"
#include "meshes/types.hpp"
#include "meshes/wall.hpp"

namespace vehd::meshes {

/// Curved volume mesh of the inside of a membrane γ and of the shell between γ and a sphere of radius R. γ can consist
/// of the membranes of several vesicles. Beside a wall the shell ends on the wall: the centre of the sphere lies on it,
/// and the mesh fills half of the sphere.
///
/// The geometry is a smooth map of every unit cell. The maps of two neighbouring cells agree on their face up to
/// rounding; the outer boundary and, for block meshes, γ are exact. Immutable, so threads can share it.
class VolumeMesh {
 public:
  virtual ~VolumeMesh() = default;

  [[nodiscard]] const MeshTopology& topology() const { return topology_; }
  [[nodiscard]] CellShape cell_shape() const { return topology_.shape; }
  [[nodiscard]] int n_cells() const { return static_cast<int>(topology_.cells.size()); }
  [[nodiscard]] const MeshCell& cell(int index) const { return topology_.cells[index]; }
  [[nodiscard]] const std::vector<InterfacePair>& interface() const { return topology_.interface; }
  [[nodiscard]] int n_vesicles() const;

  /// Centre and radius R of the outer sphere.
  [[nodiscard]] const Point& centre() const { return centre_; }
  [[nodiscard]] double outer_radius() const { return outer_radius_; }
  /// The wall on which the mesh ends, if there is one.
  [[nodiscard]] const std::optional<Wall>& wall() const { return wall_; }

  /// Position in space of a point given in unit coordinates.
  [[nodiscard]] virtual Point physical(int cell, const Point& unit) const = 0;
  /// Many points of one cell, several times faster per point.
  [[nodiscard]] virtual std::vector<Point> physical_points(int cell, const std::vector<Point>& units) const = 0;
  /// Derivative of physical() with respect to the unit coordinates: column j belongs to coordinate j.
  [[nodiscard]] virtual Matrix3 jacobian(int cell, const Point& unit) const = 0;
  /// Unit vector r̂(θ, φ) of a point of a membrane face; fields on γ are evaluated at this (θ, φ).
  /// @throws std::logic_error in a cell where the mesh defines no direction: the core of a block mesh, a tetrahedron
  /// without a membrane face
  [[nodiscard]] virtual Point direction(int cell, const Point& unit) const = 0;

  /// Positions of all vertices, in the numbering of the topology.
  [[nodiscard]] std::vector<Point> vertex_positions() const;
  /// Unit coordinates in the outside cell of the point with coordinates `inside_unit` in the inside cell.
  [[nodiscard]] Point across(const InterfacePair& pair, const Point& inside_unit) const;

 protected:
  VolumeMesh(MeshTopology topology, const Point& centre, double outer_radius, const std::optional<Wall>& wall = {})
      : topology_(std::move(topology)), centre_(centre), outer_radius_(outer_radius), wall_(wall) {}
  VolumeMesh(const VolumeMesh&) = default;
  VolumeMesh(VolumeMesh&&) = default;

 private:
  MeshTopology topology_;
  Point centre_;
  double outer_radius_;
  std::optional<Wall> wall_;
};

/// Cells, layers and radii of the block mesh.
struct BlockMeshOptions {
  /// Along each edge of the 6 blocks that divide the membrane; also in the core. If the cells are relaxed (see
  /// make_block_mesh), an odd number is increased by one.
  int cells_per_edge = 4;
  int blend_layers = 2;        ///< between core and membrane
  int shell_layers = 4;        ///< between membrane and outer sphere
  double blend_growth = 1.0;   ///< thickness of a blend layer over that of the next one towards the membrane
  double shell_growth = 0.0;   ///< the same in the shell; 0: similar cells, (R/radius)^(1/layers)
  double core_fraction = 0.6;  ///< half-width of the core over the width available within the shape
  double outer_radius = 8.0;   ///< R, about the centroid of the shape
  double smallest_scaled_jacobian = 0.02;  ///< below this an element is too flat
};

class BlockMap;

/// Hexahedra in 13 blocks: core, 6 blend blocks, 6 shell blocks. Topology vertices are reference coordinates X, in
/// which every block is straight: |X|_∞ = 1 on the membrane, 2 on the outer sphere.
class HexMesh final : public VolumeMesh {
 public:
  HexMesh(MeshTopology topology, std::shared_ptr<const BlockMap> map);

  [[nodiscard]] Point physical(int cell, const Point& unit) const override;
  [[nodiscard]] std::vector<Point> physical_points(int cell, const std::vector<Point>& units) const override;
  [[nodiscard]] Matrix3 jacobian(int cell, const Point& unit) const override;
  [[nodiscard]] Point direction(int cell, const Point& unit) const override;

 private:
  [[nodiscard]] Point reference(int cell, const Point& unit) const;
  std::shared_ptr<const BlockMap> map_;
  std::vector<Block> blocks_;
};

/// Cells run straight from the core to the membrane and on to the outer sphere (BlendedMap). If that folds them or
/// makes them too flat, they are relaxed to follow the shape (RelaxedMap).
/// @throws MeshError if the outer sphere does not enclose the shape, or if an element remains inverted or too flat
/// @throws std::invalid_argument if an option is out of range
/// Accuracy: points of membrane and outer sphere to 1e-13, neighbouring cells meet to 1e-13
/// (tests/meshes/block_mesh_test.cpp)
HexMesh make_block_mesh(const FrozenShape& shape, const BlockMeshOptions& options = {});

/// Whether make_block_mesh() relaxes the cells; needed for a bowl, in which straight lines fold.
/// @throws MeshError if the outer sphere does not enclose the shape; std::invalid_argument as make_block_mesh
bool cells_have_to_be_relaxed(const FrozenShape& shape, const BlockMeshOptions& options);

/// Sizes of the tetrahedral mesh. Lengths are in units of FrozenShape::radius() unless stated otherwise.
struct TetMeshOptions {
  double surface_size = 0.25;              ///< edge length on the membrane
  double growth = 0.35;                    ///< edge length = surface_size + growth · distance from the membrane
  double largest_size = 2.5;               ///< upper limit of the edge length
  double outer_radius = 8.0;               ///< R, an absolute length, about the centroid of the shape
  double smallest_scaled_jacobian = 0.01;  ///< below this an element is too flat
};

/// Quadratic tetrahedra: edge midpoints on γ are x at the normalised mid-direction, those on the outer boundary lie on
/// the sphere, all others are the midpoints of straight edges. Topology vertices are positions in space.
class TetMesh final : public VolumeMesh {
 public:
  /// 10 nodes of a cell: its vertices, then the midpoints of the edges 01, 12, 20, 03, 13, 23 (deal.II's order).
  /// Directions are zero off the membrane.
  struct Nodes {
    Eigen::Matrix<double, 3, 10> position;
    Eigen::Matrix<double, 3, 10> direction;
  };

  TetMesh(MeshTopology topology, std::vector<Nodes> nodes, const Point& centre, double outer_radius);

  [[nodiscard]] const Nodes& nodes(int cell) const { return nodes_[cell]; }
  [[nodiscard]] Point physical(int cell, const Point& unit) const override;
  [[nodiscard]] std::vector<Point> physical_points(int cell, const std::vector<Point>& units) const override;
  [[nodiscard]] Matrix3 jacobian(int cell, const Point& unit) const override;
  [[nodiscard]] Point direction(int cell, const Point& unit) const override;

 private:
  std::vector<Nodes> nodes_;
};

/// If an element is inverted or too flat, retries with elements on the membrane that are smaller by 3 %, then 6 %.
/// @throws MeshError if the mesher fails, the outer sphere does not enclose the shape, or an element remains inverted
/// or too flat
/// @throws std::invalid_argument if an option is out of range
/// Accuracy: order above 3 in the size for volume and area; vertices and edge midpoints on the shape to 1e-13
/// (tests/meshes/tetrahedral_mesh_test.cpp)
TetMesh make_tetrahedral_mesh(const FrozenShape& shape, const TetMeshOptions& options = {});

}  // namespace vehd::meshes
