#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// Harmonic potentials with an exact solution on any shape: sources inside γ make φ outside, sources outside γ make φ
/// inside. They obey prescribed jumps of φ and of σ ∂φ/∂n.
/// Source: paper, Example 1
struct PointSources {
  Vectors position;
  Vector strength;  ///< φ = strength/(4π|x − y|)
  std::vector<bool> inside;
  double conductivity_in = 1.0, conductivity_out = 1.0;
};

/// One level of the problem.
struct PointSourceTask {
  std::filesystem::path input;  ///< shape, conductivities and sources
  int degree = 4;
  int cells_per_edge = 3;     ///< layers of cells in proportion
  double outer_radius = 8.0;  ///< over the radius of the shape
};

/// What the level costs, and its errors.
struct PointSourceResult {
  int degree = 0, n_cells = 0;
  long n_unknowns = 0;
  double outer_radius = 0.0;
  double seconds = 0.0;  ///< of the processor, from the shape to q and f_E on γ: mesh, matrices, solve
  double seconds_mesh = 0.0;
  std::size_t peak_memory_bytes = 0;                                          ///< of the process
  double charge_l2 = 0.0, charge_max = 0.0, force_l2 = 0.0, force_max = 0.0;  ///< relative errors
};

/// Solves for the jumps of the sources and compares q and f_E with the exact ones at the points of the mesh. At the
/// outer sphere the condition is that of the check: of the exact solution it knows nothing.
/// @throws InputError, meshes::MeshError, SolveError
PointSourceResult run_point_sources(const PointSourceTask& task);

/// The result for programs.
nlohmann::json json_of(const PointSourceResult& result);

}  // namespace vehd::fem_check
