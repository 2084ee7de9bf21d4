#pragma once

#include "meshes/block_axes.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// As make_block_mesh, with the axes of the cube given: meshes of several shapes with the same axes in directions have
/// the same (θ, φ) at every node of γ.
/// @throws MeshError, std::invalid_argument as make_block_mesh
HexMesh make_block_mesh(const FrozenShape& shape, const BlockMeshOptions& options, const BlockAxes& axes);

}  // namespace vehd::meshes
