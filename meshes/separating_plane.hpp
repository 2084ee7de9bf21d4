#pragma once

#include "meshes/frozen_shape.hpp"
#include "meshes/types.hpp"

namespace vehd::meshes {

/// A plane between two membranes: normal·x = offset in the middle of a slab that is free of both.
struct SeparatingPlane {
  Point normal;         ///< unit vector from the first shape to the second
  double offset = 0.0;  ///< of the plane
  double width = 0.0;   ///< of the slab
};

/// The plane across the line between the nearest points of the convex hulls of both: about the widest slab.
///
/// The shortest vector from the first hull to the second is found by Gilbert's method over points of both surfaces,
/// until no slab can be wider by a twentieth, or as far as some thousand steps bring it.
/// @throws MeshError if no plane is found that separates the shapes
/// Source: Gilbert 1966
SeparatingPlane separating_plane(const FrozenShape& first, const FrozenShape& second);

}  // namespace vehd::meshes
