#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A plane between two membranes: normal·x = offset, in the middle of a slab that contains neither.
struct SeparatingPlane {
  Point normal;         ///< unit vector from the first shape to the second
  double offset = 0.0;  ///< of the plane from the origin
  double width = 0.0;   ///< of the slab
};

/// Plane normal to the line between the nearest points of the convex hulls of both shapes: nearly the widest slab.
///
/// Gilbert's method finds the shortest vector from the first hull to the second over sample points of both surfaces. It
/// stops when no slab can be wider by more than a twentieth, or after 5000 steps.
/// @throws MeshError if no separating plane is found
/// Source: Gilbert 1966
SeparatingPlane separating_plane(const FrozenShape& first, const FrozenShape& second);

}  // namespace vehd::meshes
