#pragma once

#include "fem_check/potential.hpp"
#include "fem_check/stiffness.hpp"

/// Terms of the membrane condition in the equations of a potential.
namespace vehd::fem_check {

/// @throws std::invalid_argument naming the value that is out of range
void require_valid(const PotentialProblem& problem);

/// Coefficient of [[u]][[w]] on γ.
PerVesicle<double> membrane_coefficient(const PotentialProblem& problem, int n_vesicles);

/// Whether the mean of V_m on a vesicle is fixed only by the value given in the problem.
bool mean_is_free(const PotentialProblem& problem, int vesicle);

/// C_m V/τ at points of γ, [points.size()].
/// @param voltage  V at the points, [points.size()]
Vector stored_current(const ChargingMembrane& charging, const SurfacePoints& points, Vector voltage);

/// Ties on γ and fixed values that remove undetermined constants.
Fixed fixed_nodes(const PotentialProblem& problem, int n_vesicles);

}  // namespace vehd::fem_check
