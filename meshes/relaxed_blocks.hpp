#pragma once

#include <vector>

#include "meshes/block_axes.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/lattice.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// The blocks of a shape that straight lines do not mesh: those of a sphere, carried along with its surface while this
/// is bent into the shape, and kept as little distorted as possible on the way (relaxed_nodes()). Outside, the inner
/// layers of the shell take part, up to a sphere that holds the shape; beyond it the shell is that of a sphere.
/// Immutable. The solution does not depend on the outer layers: meshes with more of them share it. The map is smooth
/// within the cells of meshes whose number of cells along an edge is even.
class RelaxedBlocks {
 public:
  /// @throws MeshError if the blocks cannot follow the shape
  RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options);

  [[nodiscard]] const Lattice& lattice(Region region) const { return region == Region::inside ? inside_ : outside_; }
  /// Positions of the nodes of a lattice about the centroid of the shape.
  [[nodiscard]] const Eigen::Matrix3Xd& nodes(Region region) const {
    return region == Region::inside ? inside_nodes_ : outside_nodes_;
  }
  /// Thickness of the layers that take part, and radius of the sphere that they end on.
  [[nodiscard]] double thickness() const { return thickness_; }
  [[nodiscard]] double end_radius() const { return end_radius_; }

 private:
  struct Layers {
    std::vector<double> breaks;  ///< as shares of the thickness
    double thickness;
  };
  static Layers relaxed_layers(const FrozenShape& shape, const BlockMeshOptions& options);
  RelaxedBlocks(const FrozenShape& shape, const BlockAxes& axes, const BlockMeshOptions& options, const Layers& layers);

  double thickness_, end_radius_;
  Lattice inside_, outside_;
  Eigen::Matrix3Xd inside_nodes_, outside_nodes_;
};

}  // namespace vehd::meshes
