#pragma once

#include "meshes/block.hpp"
#include "meshes/block_axes.hpp"
#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// The map from reference coordinates X to space that gives a block mesh its geometry.
///
/// Reference space consists of three nested cubes |X|_∞ = ½ (core), 1 (membrane γ), 2 (outer sphere). A point of a cube
/// face with s = |X|_∞ and v = X/s has the direction r̂ = V g/|g|, g_k = tan(π v_k/4): equal angles along block edges.
/// Every map takes s = 1 to x(r̂) and s = 2 to centre + R U g/|g|, with U and V of BlockAxes; derived classes define
/// the map in between.
class BlockMap {
 public:
  static constexpr double kCore = 0.5;
  static constexpr double kMembrane = 1.0;
  static constexpr double kOuter = 2.0;

  /// @throws MeshError if the outer sphere does not enclose the shape
  BlockMap(const FrozenShape& shape, const BlockAxes& axes, double outer_radius);
  virtual ~BlockMap() = default;
  BlockMap(const BlockMap&) = delete;
  BlockMap& operator=(const BlockMap&) = delete;

  [[nodiscard]] const Point& centre() const { return centre_; }
  [[nodiscard]] double outer_radius() const { return outer_radius_; }

  /// Block that contains a point in its interior. A point shared by several blocks belongs to each of them; the other
  /// functions therefore take the block whose formulas they use.
  [[nodiscard]] static Block block_at(const Point& reference);

  /// g/|g| on the cube face given by `axis` and `sign`; its other two coordinates v follow the axis cyclically.
  [[nodiscard]] static Point cube_direction(int axis, double sign, double first, double second);
  /// r̂(X); X ≠ 0.
  [[nodiscard]] Point direction(const Block& block, const Point& reference) const;
  [[nodiscard]] Point position(const Block& block, const Point& reference) const;
  /// Positions of many points of one block, one per column.
  [[nodiscard]] Eigen::Matrix3Xd positions(const Block& block, const Eigen::Matrix3Xd& reference) const;
  /// ∂ position/∂X.
  [[nodiscard]] virtual Matrix3 derivative(const Block& block, const Point& reference) const = 0;

 protected:
  /// Quantities common to the formulas of a block: s, v = X/s and g.
  struct CubePoint {
    double s;
    Point v;
    Point g;
  };
  [[nodiscard]] static CubePoint cube_point(const Block& block, const Point& reference);
  /// Their derivatives with respect to X, and that of g/|g|.
  struct CubeSlopes {
    Point s;
    Matrix3 v;
    Matrix3 unit;
  };
  [[nodiscard]] static CubeSlopes cube_slopes(const Block& block, const CubePoint& point);

  [[nodiscard]] const FrozenShape& shape() const { return shape_; }
  [[nodiscard]] const Matrix3& block_to_direction() const { return axes_.in_directions; }
  [[nodiscard]] const Matrix3& block_to_space() const { return axes_.in_space; }

 private:
  [[nodiscard]] virtual Point in_core(const Point& reference) const = 0;
  /// Position outside the core, given x(r̂).
  [[nodiscard]] virtual Point around_core(const Block& block, const Point& reference,
                                          const Point& on_membrane) const = 0;

  FrozenShape shape_;
  Point centre_;
  double outer_radius_;
  BlockAxes axes_;
};

/// Thickness of a shell layer over that of the next one inwards, for a shape of this radius.
double shell_growth(const BlockMeshOptions& options, double radius);

/// Vertices, cells and interface of the reference mesh, made by gmsh from 13 transfinite blocks. The third unit
/// coordinate of every blend and shell cell points outwards.
/// @throws MeshError if the mesher fails
MeshTopology make_block_topology(const BlockMeshOptions& options, double shell_growth);

}  // namespace vehd::meshes
