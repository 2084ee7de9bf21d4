#pragma once

#include <array>
#include <vector>

#include "meshes/block.hpp"
#include "meshes/mesh_topology.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A place in a block by coordinates that run along its edges: three across the core in [−1, 1]; two across a blend or
/// shell block in [−1, 1], the third outwards in [0, 1]. Of a block with the axis k the first two are v_{k+1} and
/// v_{k+2}, cyclically.
struct BlockPlace {
  Block block;
  Point at;
};

/// Polynomial cells that fill the blocks of one side of the membrane, with nodes shared between neighbours: how a map
/// of these blocks is given by positions of nodes. The inside has the core and one layer of blend blocks, the outside
/// one layer of shell blocks.
class Lattice {
 public:
  /// Entity on which a node lies.
  enum class Boundary { none, membrane, outer };
  struct Node {
    BlockPlace place;  ///< in one of its cells
    Boundary boundary;
  };
  struct Cell {
    std::vector<int> nodes;  ///< first coordinate fastest
  };

  /// @param breaks  of the third coordinate between layers of cells, from 0 to 1; ascending
  Lattice(Region region, int cells_per_edge, int degree, std::vector<double> breaks);

  [[nodiscard]] Region region() const { return region_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] const std::vector<Node>& nodes() const { return nodes_; }
  [[nodiscard]] const std::vector<Cell>& cells() const { return cells_; }
  /// Between the layers of cells.
  [[nodiscard]] const std::vector<double>& breaks() const { return breaks_; }

  /// Value and derivative, by the coordinates of the block, of the field whose values at the nodes are given.
  struct Sample {
    Point value;
    Matrix3 derivative;
  };
  /// Both at a place of the block.
  /// @param nodal  [3 x nodes]
  [[nodiscard]] Sample sample(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const;
  /// The value alone.
  [[nodiscard]] Point value(const Eigen::Matrix3Xd& nodal, const BlockPlace& place) const;

 private:
  /// Cell that holds a place, and its coordinates there, in [0, 1].
  struct Located {
    const Cell* cell;
    Point unit;
    Point scale;  ///< of the unit coordinates by those of the block
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
