#pragma once

#include <filesystem>

#include "meshes/mesh_quality.hpp"
#include "meshes/volume_mesh.hpp"

namespace vehd::meshes {

/// Writes the mesh for gmsh: MSH 4.1 with second-order elements (27-node hexahedra, 10-node tetrahedra) on the curved
/// geometry, physical groups "inside" and "outside", the membrane faces with outward normals on the nodes of the inside
/// ("membrane") and of the outside ("membrane_outside"), and the smallest scaled Jacobian of every cell as a view. With
/// several vesicles, the groups of each have its number appended, as "inside_0"; "outside" is shared.
/// @throws MeshError if the file cannot be written
void write_msh(const std::filesystem::path& file, const VolumeMesh& mesh, const MeshQuality& quality);

}  // namespace vehd::meshes
