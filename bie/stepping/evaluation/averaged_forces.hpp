#pragma once

#include <vector>

#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// Mean of f_E over a period for each vesicle, with the amplitudes of V_m and q as by-products among its fields, see
/// solve_averaged_fields.
/// @return  values on the upsampled grids
/// @throws ConvergenceError
std::vector<Matrix> averaged_forces(const std::vector<VesicleTask>& tasks, SolvedFields& solved);

}  // namespace vehd
