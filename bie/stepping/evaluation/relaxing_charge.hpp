#pragma once

#include "bie/stepping/evaluation/vesicle_task.hpp"

namespace vehd {

/// f_E of the free charges of a state, with V_m, q and the rates of the charges as by-products, see field_of_charges.
/// @param electric  of the time
/// @return  values on the upsampled grid
/// @throws ConvergenceError
Matrix force_of_charges(const VesicleTask& task, const ElectricParameters& electric, int& iterations);

/// The same where there is no charge and no field.
void without_charges(const VesicleTask& task);

}  // namespace vehd
