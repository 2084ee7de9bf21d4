#pragma once

#include "meshes/block.hpp"
#include "meshes/block_axes.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// The smooth map from reference coordinates X to space that gives a block mesh its geometry.
///
/// Reference space is three nested cubes |X|_∞ = ½ (core), 1 (membrane γ), 2 (outer sphere). A face of the cube with
/// s = |X|_∞ and v = X/s belongs to the direction r̂ = V g/|g|, g_k = tan(π v_k/4): equal angles along block edges.
///   core:   centre + K X/½
///   blend:  from centre + K v at s = ½ to x(r̂) at s = 1, linear in s
///   shell:  from x(r̂) at s = 1 to centre + R U g/|g| at s = 2, linear in s
/// U and V are the BlockAxes. K = U diag(half-widths) squashes the core into the room that the shape leaves along each
/// axis.
class BlockMap {
 public:
  static constexpr double kCore = 0.5;
  static constexpr double kMembrane = 1.0;
  static constexpr double kOuter = 2.0;

  /// @throws MeshError if the outer sphere does not hold the shape
  BlockMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius, double core_fraction);

  [[nodiscard]] const Point& centre() const { return centre_; }
  [[nodiscard]] double outer_radius() const { return outer_radius_; }

  /// Block that holds a point in its interior. A point of several blocks lies on each of them: the other functions
  /// take the formulas of the block that they are given.
  [[nodiscard]] static Block block_at(const Point& reference);

  /// g/|g| on the face of the cube that `axis` and `sign` name; its other coordinates v follow the axis cyclically.
  [[nodiscard]] static Point cube_direction(int axis, double sign, double first, double second);
  /// r̂(X); X ≠ 0.
  [[nodiscard]] Point direction(const Block& block, const Point& reference) const;
  [[nodiscard]] Point position(const Block& block, const Point& reference) const;
  /// Many columns at once, all of one block.
  [[nodiscard]] Eigen::Matrix3Xd positions(const Block& block, const Eigen::Matrix3Xd& reference) const;
  /// ∂ position/∂X.
  [[nodiscard]] Matrix3 derivative(const Block& block, const Point& reference) const;

 private:
  /// Position where x(r̂) is known already.
  [[nodiscard]] Point blended(const Block& block, const Point& reference, const Point& on_membrane) const;

  FrozenShape shape_;
  Point centre_;
  double outer_radius_;
  Matrix3 block_to_direction_;  // V
  Matrix3 block_to_space_;      // U
  Matrix3 core_;                // K
};

/// Vertices, cells and interface of the reference mesh, made by gmsh: 13 transfinite blocks. The third unit coordinate
/// of every blend and shell cell points outwards.
/// @throws MeshError if the mesher fails
MeshTopology make_block_topology(const BlockMeshOptions& options, double shell_growth);

}  // namespace vehd::meshes
