#pragma once

#include "bie/physics/wall.hpp"
#include "bie/sphere/exchange.hpp"

/// Mirror images of whole membranes, to which scenes with a wall are compared.
namespace vehd::testing {

/// A wall in general position.
inline Wall oblique_wall(WallFlow flow, WallField field) {
  return {{0.4, -1.0, 0.3}, Vector3(0.3, -0.4, 1.2).normalized(), flow, field};
}

/// A parametrisation that keeps normals pointing outwards: x'(g s) is the mirror image of x(s), g the mirror y of the
/// parameter sphere.
struct MirrorImage {
  Wall wall;
  ImageOfFields parameters{{{1, -1, 1}}};

  [[nodiscard]] Matrix scalar(const Matrix& field) const { return parameters.scalar(field); }
  [[nodiscard]] Matrix vector(const Matrix& field) const { return parameters.scalar(field) * wall.mirror(); }
  [[nodiscard]] Matrix position(const Matrix& x) const {
    Matrix result = vector(x);
    result.row(0) += std::sqrt(4.0 * std::numbers::pi) * 2.0 * wall.normal.dot(wall.point) * wall.normal.transpose();
    return result;
  }
};

/// Moved along the normal until it is this far from the wall.
inline Matrix at_gap(const Wall& wall, Matrix position, double gap) {
  const double by = gap - nearest_to_wall(wall, position).distance;
  position.row(0) += std::sqrt(4.0 * std::numbers::pi) * by * wall.normal.transpose();
  return position;
}

}  // namespace vehd::testing
