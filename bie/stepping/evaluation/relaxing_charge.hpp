#pragma once

#include <vector>

#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// f_E of the free charges of each vesicle, with V_m, q and the rates of the charges as by-products, see
/// fields_of_charges.
/// @param limit   which value of the field counts where it jumps
/// @param solved  with the interaction of several vesicles
/// @return  values on the upsampled grids; of vesicles of other ranks all stay empty
/// @throws ConvergenceError
std::vector<Matrix> forces_of_charges(const std::vector<VesicleTask>& tasks, double time, Limit limit,
                                      SolvedFields& solved);

/// All electric fields and rates, which are zero where there is no charge and no field.
void without_charges(const VesicleTask& task);

}  // namespace vehd
