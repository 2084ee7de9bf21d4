#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A plane that bounds the outside.
struct Wall {
  Point point = Point::Zero();    ///< any of the plane
  Point normal = Point::UnitZ();  ///< unit, to the side of the membrane
};

/// Least distance of a membrane from the wall, over points of it; negative where it crosses the wall.
double gap_to(const Wall& wall, const FrozenShape& shape);

}  // namespace vehd::meshes
