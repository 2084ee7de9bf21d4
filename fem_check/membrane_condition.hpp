#pragma once

#include "fem_check/potential.hpp"
#include "fem_check/stiffness.hpp"

/// Terms of the membrane's condition in the equations of a potential.
namespace vehd::fem_check {

/// @throws std::invalid_argument naming what is out of range
void require_valid(const PotentialProblem& problem);

/// Coefficient of [[u]][[w]] on γ.
PerVesicle<double> membrane_coefficient(const PotentialProblem& problem, int n_vesicles);

/// Whether nothing but the problem's own value fixes the mean of V_m on a vesicle.
bool mean_is_free(const PotentialProblem& problem, int vesicle);

/// C_m V/τ at points of γ, [points.size()].
/// @param voltage  V there, likewise
Vector stored_current(const ChargingMembrane& charging, const SurfacePoints& points, Vector voltage);

/// Ties on γ and values that would float.
Fixed fixed_nodes(const PotentialProblem& problem, int n_vesicles);

}  // namespace vehd::fem_check
