#pragma once

#include <optional>

#include "fem_check/app/check_input.hpp"
#include "fem_check/app/level.hpp"
#include "fem_check/app/progress.hpp"
#include "fem_check/app/refinement.hpp"

namespace vehd::fem_check {

/// V_m that the finite elements have advanced from an earlier snapshot; every level includes the effect of the smallest
/// time step. Surface field: Vm.
struct ChargingLevels {
  LevelSequence sequence;
  Eigen::MatrixXd time_error;           ///< of V_m due to its time steps, [1 x points] of the comparison
  std::optional<double> order_in_time;  ///< observed from the last three numbers of steps
  int steps = 0;                        ///< the largest number, between two discontinuities of the field
};

/// Advances V_m by backward differentiation of order 2. The number of steps is chosen with elements of the lowest
/// degree; higher degrees take few steps, and the change due to more steps at the lowest degree is added.
/// @param input  must have in_time
/// @throws SolveError, meshes::MeshError
ChargingLevels solve_charging_levels(const CheckInput& input, Meshes& meshes, const Refinement& refinement,
                                     const Report& report);

}  // namespace vehd::fem_check
