#pragma once

#include <array>
#include <vector>

#include "meshes/tetrahedron_filler.hpp"

namespace vehd::meshes {

/// Refines tetrahedra until none has two faces on the membrane: since the membrane is smooth, two curved faces of one
/// cell would meet at 180° and the map would be singular along their common edge. The edge opposite to that one is
/// split by a new vertex, placed inside the volume where it is best for the flattest new cell.
/// @param triangles  of the membrane, vertex numbers of `volumes`
void separate_membrane_faces(FilledVolumes& volumes, const std::vector<std::array<int, 3>>& triangles);

}  // namespace vehd::meshes
