#pragma once

#include <nlohmann/json.hpp>

#include "fem_check/app/level_task.hpp"

namespace vehd::fem_check {

/// Cost of the flow from the shape, and the differences of its fields from those of the boundary integrals.
struct ShapeFlowResult {
  LevelCost cost;
  FieldError velocity;  ///< v without the background flow
  FieldError tension;   ///< λ
};

/// Finds q, f_E, f_b, λ and v from the shape, V_m and the physics on one level and compares the last two.
/// @param task  its input is a check_input.h5 with a flow, whose numbers of /bie count as exact
/// @throws InputError, meshes::MeshError, SolveError
ShapeFlowResult run_shape_flow(const LevelTask& task);

/// The result for programs.
nlohmann::json json_of(const ShapeFlowResult& result);

}  // namespace vehd::fem_check
