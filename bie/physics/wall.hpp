#pragma once

#include "bie/sphere/transform.hpp"

namespace vehd {

/// Condition of the flow at a wall.
enum class WallFlow { none, no_slip, stress_free };
/// Condition of the electric field at a wall.
enum class WallField { none, insulating, electrode };

/// A plane that bounds the fluid; its normal points into the fluid. `none`: the wall does not affect the flow, or the
/// field.
struct Wall {
  Vector3 point = Vector3::Zero();    ///< any point of the plane
  Vector3 normal = Vector3::UnitZ();  ///< unit, into the fluid
  WallFlow flow = WallFlow::none;     ///< no slip, or a free surface that stays flat
  WallField field = WallField::none;  ///< no current through it, or a constant potential

  /// Height of a point above the wall, > 0 in the fluid.
  [[nodiscard]] double height(const Vector3& x) const { return normal.dot(x - point); }
  /// I − 2 n nᵀ, which takes vectors to their mirror images.
  [[nodiscard]] Matrix3 mirror() const { return Matrix3::Identity() - 2.0 * normal * normal.transpose(); }
};

/// Point of a membrane nearest to a wall.
struct WallGap {
  double distance = 0.0;            ///< negative if the membrane crosses the wall
  Vector3 place = Vector3::Zero();  ///< on the membrane
};

/// The point of a membrane that is nearest to a wall.
/// @param fine      degree p ↔ a finer grid, from whose lowest nodes the search starts
/// @param position  coefficients of x, [n_coefficients x 3]
/// Accuracy: that of top_of on that grid
WallGap nearest_to_wall(const Wall& wall, const SphereTransform& fine, const Matrix& position);
/// The point of a membrane that is nearest to a wall, found on a grid of twice its degree.
/// @param position  coefficients of x, [n_coefficients x 3]
WallGap nearest_to_wall(const Wall& wall, const Matrix& position);

}  // namespace vehd
