#pragma once

#include <filesystem>

#include "meshes/mesh_quality.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// Writes the mesh for the gmsh program: MSH 4.1 with second-order elements (27-node hexahedra, 10-node tetrahedra) on
/// the curved geometry, physical groups "inside" and "outside", the faces of the membrane with their normals outwards
/// on the nodes of the inside ("membrane") and on those of the outside ("membrane_outside"), and the smallest scaled
/// Jacobian of every cell as a view. Of several vesicles each has groups of its own with its number behind their names,
/// "inside_0", but for the outside.
/// @throws MeshError if the file cannot be written
void write_msh(const std::filesystem::path& file, const VolumeMesh& mesh, const MeshQuality& quality);

}  // namespace vehd::meshes
