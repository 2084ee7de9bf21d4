#pragma once

#include "meshes/block_axes.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// As make_block_mesh, with given axes of the cube: meshes of several shapes with equal axes in directions have equal
/// (θ, φ) at corresponding nodes of γ.
/// @throws MeshError, std::invalid_argument as make_block_mesh
HexMesh make_block_mesh(const FrozenShape& shape, const BlockMeshOptions& options, const BlockAxes& axes);

}  // namespace vehd::meshes
