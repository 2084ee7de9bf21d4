#pragma once

#include <vector>

#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// The forces on all membranes of this rank and their velocities, with the tensions that keep them inextensible,
/// Eqs. (2), (5), (27b).
/// @param forces_electric  f_E of each, values on the upsampled grid; empty where it is zero
/// @param limit            which value counts where a waveform jumps
/// @param solved           with the interaction; the iterations are added there
/// @throws ConvergenceError if the tensions do not converge
void solve_velocities(const std::vector<VesicleTask>& tasks, const std::vector<Matrix>& forces_electric, double time,
                      Limit limit, Instruments& instruments, SolvedFields& solved);

}  // namespace vehd
