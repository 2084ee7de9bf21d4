#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "fem_check/app/level_task.hpp"
#include "fem_check/types.hpp"

namespace vehd::fem_check {

/// Harmonic potentials with an exact solution on any shape: sources inside γ generate φ outside, sources outside γ
/// generate φ inside. They satisfy prescribed jumps of φ and of σ ∂φ/∂n.
/// Source: paper, Example 1
struct PointSources {
  Vectors position;
  Vector strength;  ///< φ = strength/(4π|x − y|)
  std::vector<bool> inside;
  double conductivity_in = 1.0, conductivity_out = 1.0;
};

/// Cost and errors of a level.
struct PointSourceResult {
  LevelCost cost;
  FieldError charge, force;
};

/// Solves for the jumps of the sources and compares q and f_E with the exact ones at the points of the mesh. The
/// condition at the outer sphere is that of the check and does not use the exact solution.
/// @param task  with shape, conductivities and sources in its input
/// @throws InputError, meshes::MeshError, SolveError
PointSourceResult run_point_sources(const LevelTask& task);

/// The result as JSON.
nlohmann::json json_of(const PointSourceResult& result);

}  // namespace vehd::fem_check
