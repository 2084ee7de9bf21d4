#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A plane that bounds the outside.
struct Wall {
  Point point = Point::Zero();    ///< any point of the plane
  Point normal = Point::UnitZ();  ///< unit vector towards the side of the membrane
};

/// Smallest distance of a membrane from the wall, over sample points; negative if it crosses the wall.
double gap_to(const Wall& wall, const FrozenShape& shape);

}  // namespace vehd::meshes
