#pragma once

#include <vector>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/flow_setups.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/potential_levels.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"
#include "fem_check/flow.hpp"

namespace vehd::fem_check {

/// Flows at rising degree. Surface fields: velocity and divergence (force given); samples: velocity.
struct FlowLevels {
  LevelSequence sequence;
  std::vector<FlowSolution> solutions;  ///< of every level, force given
};

/// Solves the flow with the given force.
/// @param inputs  of all vesicles of the meshes; the samples are those of the first
/// @throws SolveError
FlowLevels solve_flow_levels(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                             const Refinement& refinement, const Report& report);

/// Adds velocity_own_force, with f_E of the finite elements instead of the snapshot's in the force, to the last two
/// levels. Stokes flow is linear, so only the change is solved, at rising degree until its error is small compared with
/// that of the flow; the two levels differ by the remaining error and by that of f_E.
void add_own_force(const std::vector<CheckInput>& inputs, Meshes& meshes, FlowSetups& setups,
                   const Refinement& refinement, const PotentialLevels& potential, LevelSequence& sequence,
                   const Report& report);

}  // namespace vehd::fem_check
