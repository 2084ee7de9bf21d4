#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "meshes/mesh_quality.hpp"

namespace vehd::fem_check {

/// Mesh to make, and its file.
struct MeshTask {
  std::filesystem::path input;   ///< file with the shapes, one or two
  std::filesystem::path output;  ///< MSH 4.1
  std::string family = "hex";    ///< or "tet"
  int refine = 0;                ///< number of times that the element size is divided by 1.5
};

/// Properties of the mesh.
struct MeshResult {
  std::string family;
  int n_cells = 0, n_faces = 0;  ///< n_faces: on the membrane
  double outer_radius = 0.0;
  std::vector<double> shape_volumes, shape_areas;  ///< of each vesicle
  meshes::MeshQuality quality;
};

/// Meshes the shapes and writes the mesh. @throws InputError, meshes::MeshError
MeshResult run_mesh(const MeshTask& task);

/// The properties as text.
std::string text_of(const MeshResult& result);
/// The properties as JSON.
nlohmann::json json_of(const MeshResult& result);

}  // namespace vehd::fem_check
