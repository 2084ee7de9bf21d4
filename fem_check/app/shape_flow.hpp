#pragma once

#include <nlohmann/json.hpp>

#include "fem_check/app/level_task.hpp"

namespace vehd::fem_check {

/// Cost of the flow determined by the shape, and errors of its fields relative to the boundary integrals.
struct ShapeFlowResult {
  LevelCost cost;
  FieldError velocity;  ///< v without the background flow
  FieldError tension;   ///< λ
};

/// Computes q, f_E, f_b, λ and v from shape, V_m and material parameters on one level; compares λ and v.
/// @param task  its input is a check_input.h5 with a flow, whose fields in /bie count as exact
/// @throws InputError, meshes::MeshError, SolveError
ShapeFlowResult run_shape_flow(const LevelTask& task);

/// The result as JSON.
nlohmann::json json_of(const ShapeFlowResult& result);

}  // namespace vehd::fem_check
