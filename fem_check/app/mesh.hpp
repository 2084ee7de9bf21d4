#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "meshes/mesh_quality.hpp"

namespace vehd::fem_check {

/// Which mesh is made, and where it goes.
struct MeshTask {
  std::filesystem::path input;   ///< file with the shapes, one or two
  std::filesystem::path output;  ///< MSH 4.1
  std::string family = "hex";    ///< or "tet"
  int refine = 0;                ///< how often the element size is divided by 1.5
};

/// Figures of the mesh.
struct MeshResult {
  std::string family;
  int n_cells = 0, n_faces = 0;  ///< faces: on the membrane
  double outer_radius = 0.0;
  std::vector<double> shape_volumes, shape_areas;  ///< of each vesicle
  meshes::MeshQuality quality;
};

/// Meshes the shapes and writes the mesh. @throws InputError, meshes::MeshError
MeshResult run_mesh(const MeshTask& task);

/// The figures for people.
std::string text_of(const MeshResult& result);
/// The figures for programs.
nlohmann::json json_of(const MeshResult& result);

}  // namespace vehd::fem_check
