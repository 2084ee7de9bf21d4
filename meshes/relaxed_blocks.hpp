#pragma once

#include <vector>

#include "meshes/block_axes.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/lattice.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// Blocks of a shape that straight lines cannot mesh: the blocks of a sphere, deformed with its surface into the shape
/// and kept as little distorted as possible (relaxed_nodes()). Outside, the inner layers of the shell are deformed too,
/// out to a sphere that encloses the shape; beyond it the shell is that of a sphere. Immutable. The solution does not
/// depend on the outer layers, so meshes with different outer layers can share it. The map is smooth within every cell
/// of a mesh whose number of cells along an edge is even.
class RelaxedBlocks {
 public:
  /// @throws MeshError if the blocks cannot follow the shape
  RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options);

  [[nodiscard]] const Lattice& lattice(Region region) const { return region == Region::inside ? inside_ : outside_; }
  /// Positions of the nodes of a lattice, relative to the centroid of the shape.
  [[nodiscard]] const Eigen::Matrix3Xd& nodes(Region region) const {
    return region == Region::inside ? inside_nodes_ : outside_nodes_;
  }
  /// Thickness of the deformed layers, and radius of the sphere on which they end.
  [[nodiscard]] double thickness() const { return thickness_; }
  [[nodiscard]] double end_radius() const { return end_radius_; }

 private:
  struct Layers {
    std::vector<double> breaks;  ///< as fractions of the thickness
    double thickness;
  };
  static Layers relaxed_layers(const FrozenShape& shape, const BlockMeshOptions& options);
  RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options, const Layers& layers);

  double thickness_, end_radius_;
  Lattice inside_, outside_;
  Eigen::Matrix3Xd inside_nodes_, outside_nodes_;
};

}  // namespace vehd::meshes
