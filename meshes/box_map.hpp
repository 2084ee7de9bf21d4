#pragma once

#include <array>
#include <vector>

#include "meshes/frozen_shape.hpp"
#include "meshes/separating_plane.hpp"
#include "meshes/types.hpp"
#include "meshes/wall.hpp"

namespace vehd::meshes {

/// One of the 36 blocks of a mesh about two membranes: a core, 6 blend blocks and 6 box blocks for each of them, and 10
/// blocks from both boxes to the outer sphere. Beside a wall a mesh has one half of them.
struct BoxBlock {
  enum class Layer { core, blend, box, outer };
  Layer layer;
  int vesicle;  ///< 0 or 1; of an outer block that whose box it stands on
  int axis;     ///< the axis that cuts the block's face of the box; means nothing in the core
  double sign;  ///< +1 or −1: on which side
};

/// How these blocks lie.
struct BoxOptions {
  double core_fraction = 0.6;  ///< half-width of the cores over the width that the shapes leave them
  double margin = 0.6;  ///< of the boxes about their membranes, over the larger radius; as wide as the gap at a wall
  double outer_radius = 8.0;  ///< R, about the middle of both boxes, which lies in the wall
};

/// Blocks about two membranes on either side of a plane, or about one beside a wall as if its mirror image were the
/// other.
///
/// Each membrane has a box; the boxes share a face, which lies in the plane. A face of a box, with its coordinates v in
/// [−1, 1]², g_k = tan(π v_k/4) and g = ±1 along its axis, belongs to the directions r̂ = A g/|A g| with A = M⁻¹ U W: of
/// an ellipsoid x = x_0 + M r̂ exactly the part that lies before it, seen from its centre; U has the axes of the boxes
/// and W the half-widths of the shape along them. Straight lines lead from the core c + K v to x(r̂), on to the point of
/// the box with the coordinates g, and from there, away from the middle of both boxes, to the outer sphere. On a wall
/// the point of the box is the foot of x(r̂) in the middle of the face and goes over into that of g at its edges, so
/// that narrow gaps keep their cells.
class BoxMap {
 public:
  /// @throws MeshError if no plane separates the shapes, or if the outer sphere does not hold the boxes
  BoxMap(const std::array<FrozenShape, 2>& shapes, const BoxOptions& options);
  /// @throws MeshError if the shape crosses the wall, or if the outer sphere does not hold the boxes
  BoxMap(const FrozenShape& shape, const Wall& wall, const BoxOptions& options);

  /// Middle of both boxes.
  [[nodiscard]] const Point& centre() const { return centre_; }

  /// @param at  across the block in [−1, 1] twice, the third outwards in [0, 1]; in a core all three in [−1, 1].
  /// Right-handed
  [[nodiscard]] Point position(const BoxBlock& block, const Point& at) const;
  /// Many columns at once.
  [[nodiscard]] Eigen::Matrix3Xd positions(const BoxBlock& block, const Eigen::Matrix3Xd& at) const;
  /// ∂ position/∂at.
  [[nodiscard]] Matrix3 derivative(const BoxBlock& block, const Point& at) const;
  /// r̂ of a place outside the cores.
  [[nodiscard]] Point direction(const BoxBlock& block, const Point& at) const;

 private:
  using Slopes = Eigen::Matrix<double, 3, 2>;
  /// A point of a surface that blocks lie between, with its derivatives by the coordinates across.
  struct SurfacePoint {
    Point at;
    Slopes slopes;
  };
  /// v or g of a place, which is to be understood on the cube.
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
    Matrix3 half;          // from g to the box about its middle
  };
  BoxMap(const std::vector<FrozenShape>& shapes, const SeparatingPlane& plane, const BoxOptions& options);
  static Matrix3 axes_along(const Point& normal, const std::vector<FrozenShape>& shapes);
  static Matrix3 core_of(const Box& box, const Matrix3& widths, double fraction);

  std::vector<Box> boxes_;
  bool beside_wall_;
  Point centre_;
  double outer_radius_;
};

}  // namespace vehd::meshes
