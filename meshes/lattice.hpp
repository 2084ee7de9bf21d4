#pragma once

#include <array>
#include <vector>

#include "meshes/block.hpp"
#include "meshes/mesh_topology.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A point of a block in coordinates that run along its edges: three across the core in [−1, 1]; in a blend or shell
/// block two across in [−1, 1] and the third outwards in [0, 1]. In a block with axis k the first two are v_{k+1} and
/// v_{k+2}, cyclically.
struct BlockPlace {
  Block block;
  Point at;
};

/// Polynomial cells that fill the blocks on one side of the membrane, with nodes shared between neighbours: a map of
/// these blocks is given by the positions of the nodes. The inside has the core and the blend blocks, the outside the
/// shell blocks.
class Lattice {
 public:
  /// Boundary on which a node lies.
  enum class Boundary { none, membrane, outer };
  struct Node {
    BlockPlace place;  ///< in one of its cells
    Boundary boundary;
  };
  struct Cell {
    std::vector<int> nodes;  ///< first coordinate fastest
  };

  /// @param breaks  boundaries of the layers of cells in the third coordinate, ascending from 0 to 1
  Lattice(Region region, int cells_per_edge, int degree, std::vector<double> breaks);

  [[nodiscard]] Region region() const { return region_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  /// Boundaries of the layers of cells.
  [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }

  /// Value of the field with given nodal values, and its derivative with respect to the coordinates of the block.
  struct Sample {
    Point value;
    Matrix3 derivative;
  };
  /// Value and derivative at a point of a block.
  /// @param nodal  [3 x nodes]
  [[nodiscard]] Sample sample(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const;
  /// Value only.
  [[nodiscard]] Point value(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const;

 private:
  /// Cell that contains a point, and its coordinates in this cell, in [0, 1].
  struct Located {
    const Cell* cell;
    Point unit;
    Point scale;  ///< derivatives of the unit coordinates with respect to those of the block
  };
  [[nodiscard]] Located locate(const BlockPlace& place) const;

  Region region_;
  int cells_per_edge_;
  int degree_;
  std::vector<double> breaks_;
  std::vector<double> line_;  ///< Gauss–Lobatto nodes on [0, 1]
  std::vector<Node> nodes_;
  std::vector<Cell> cells_;
};

}  // namespace vehd::meshes
