#pragma once

#include <array>
#include <vector>

#include "meshes/frozen_shape.hpp"
#include "meshes/separating_plane.hpp"
#include "meshes/types.hpp"
#include "meshes/wall.hpp"

namespace vehd::meshes {

/// One of the 36 blocks of a mesh about two membranes: a core, 6 blend blocks and 6 box blocks for each membrane, and
/// 10 blocks between the two boxes and the outer sphere. A mesh beside a wall has half of these blocks.
struct BoxBlock {
  enum class Layer { core, blend, box, outer };
  Layer layer;
  int vesicle;  ///< 0 or 1; for an outer block, the vesicle whose box it touches
  int axis;     ///< axis that cuts the block's face of the box; unused in the core
  double sign;  ///< +1 or −1: the side of the box
};

/// Geometry of these blocks.
struct BoxOptions {
  double core_fraction = 0.6;  ///< half-width of the cores over the width that the shapes leave them
  double margin = 0.6;         ///< between membranes and boxes, over the larger radius; at a wall at least the gap
  double outer_radius = 8.0;   ///< R, about the middle of both boxes, which lies on the wall if there is one
};

/// Map of the blocks about two membranes on either side of a plane, or about one membrane beside a wall as if its
/// mirror image were the second one.
///
/// Each membrane has a box; the boxes share a face, which lies in the plane. A point of a box face with coordinates v
/// in [−1, 1]², g_k = tan(π v_k/4) and g = ±1 along its axis, has the direction r̂ = A g/|A g|, A = M⁻¹ U W; the
/// columns of U are the axes of the boxes, W has the half-widths of the shape along them. For an ellipsoid x = x_0 + M
/// r̂, x − x_0 is then parallel to U W g. A may be that of another shape, of which this one is a deformation; K is
/// parallel to M A. Straight lines lead from the core c + K v to x(r̂), on to the point of the box with coordinates g,
/// and from there, away from the middle of both boxes, to the outer sphere. On a wall the lines end at the foot of x(r̂)
/// in the middle of the face, and blend into the point of g towards its edges, so that narrow gaps are resolved.
class BoxMap {
 public:
  /// @throws MeshError if no plane separates the shapes, or if the outer sphere does not enclose the boxes
  BoxMap(const std::array<FrozenShape, 2>& shapes, const BoxOptions& options);
  /// @param like  the shape that determines A
  /// @throws MeshError if the shape crosses the wall, or if the outer sphere does not enclose the boxes
  BoxMap(const FrozenShape& shape, const FrozenShape& like, const Wall& wall, const BoxOptions& options);

  /// Middle of both boxes.
  [[nodiscard]] const Point& centre() const { return centre_; }

  /// @param at  two coordinates across the block in [−1, 1], the third outwards in [0, 1]; all three in [−1, 1] in a
  ///            core. Right-handed
  [[nodiscard]] Point position(const BoxBlock& block, const Point& at) const;
  /// Positions of many points, one per column.
  [[nodiscard]] Eigen::Matrix3Xd positions(const BoxBlock& block, const Eigen::Matrix3Xd& at) const;
  /// ∂ position/∂at.
  [[nodiscard]] Matrix3 derivative(const BoxBlock& block, const Point& at) const;
  /// r̂ of a point outside the cores.
  [[nodiscard]] Point direction(const BoxBlock& block, const Point& at) const;

 private:
  using Slopes = Eigen::Matrix<double, 3, 2>;
  /// Point of a surface between blocks, and its derivatives with respect to the coordinates across.
  struct SurfacePoint {
    Point at;
    Slopes slopes;
  };
  /// v and g of a point on the cube, and their derivatives with respect to the coordinates across.
  struct CubePoint {
    Point v, g;
    Slopes v_slopes, g_slopes;
  };
  static CubePoint cube_point(const BoxBlock& block, const Point& at);

  [[nodiscard]] SurfacePoint on_core(const BoxBlock& block, const CubePoint& point) const;
  [[nodiscard]] SurfacePoint on_membrane(const BoxBlock& block, const CubePoint& point) const;
  [[nodiscard]] SurfacePoint on_box(const BoxBlock& block, const CubePoint& point) const;
  [[nodiscard]] SurfacePoint on_face(const BoxBlock& block, const CubePoint& point, const SurfacePoint& membrane) const;
  [[nodiscard]] SurfacePoint on_sphere(const SurfacePoint& on_box) const;
  [[nodiscard]] Point place(const BoxBlock& block, const Point& at, const Point& on_membrane) const;

  /// Data of one vesicle.
  struct Box {
    FrozenShape shape;
    Matrix3 to_direction;  // A
    Matrix3 core;          // K
    Point middle;          // of the box
    Matrix3 half;          // from g to the box relative to its middle
  };
  BoxMap(const std::vector<FrozenShape>& shapes, const std::vector<FrozenShape>& like, const SeparatingPlane& plane,
         const BoxOptions& options);
  static Matrix3 axes_along(const Point& normal, const std::vector<FrozenShape>& shapes);
  static Matrix3 core_of(const Box& box, double fraction);

  std::vector<Box> boxes_;
  bool beside_wall_;
  Point centre_;
  double outer_radius_;
};

}  // namespace vehd::meshes
