#pragma once

#include <vector>

#include "bie/physics/current_law.hpp"

namespace vehd {

/// Backward Euler of (4e): a = C_m/dt + G, k = σ and s_i = −s_e = (C_m/dt) V − J with a current G V + J through the
/// membrane.
/// @param dt         > 0; infinite for the steady state
/// @param potential  V_m before the step, coefficients
/// Source: paper Eqs. (4e), (30)
CurrentLaw law_of_charging(const ChargingMembrane& of, const MembraneCurrent& current, double dt,
                           const Vector& potential);

/// V_m of all membranes after one backward-Euler step of (4e)/(14), Eq. (30), in one solve at every contrast and time
/// constant: with a = C_m/dt + G_m, b = (C_m/dt) V_m − J_p, κ = σ_i σ_e/(σ_i + σ_e), the unknown V of one obeys
///   (½ + ηS′)(a V − b) − κ D′[V] = κ E·n.
/// @param interaction  of the membranes; null where there is one
/// @param dt           > 0
/// @param potentials   V_m of each before the step on input, after it on output
/// @throws InputError  as solve_laws
/// Accuracy: first order in dt, spectral in space; each step on the sphere is backward Euler to 1e-11
/// (tests/physics/charging_test.cpp); the multipoles of two spheres charge as their linear system says
/// (tests/physics/coupled_electric_test.cpp)
/// Source: paper Eqs. (14), (29), (30), without the inverse
SolveReport charge_membranes(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction, double dt,
                             double tolerance, std::vector<Vector>& potentials);

/// Steady V_m: C_m/dt → 0 in charge_membranes.
/// @param potentials   first guesses on input, empty ones are zero; the steady V_m of each on output
/// @throws InputError  if nothing determines it (a membrane and a fluid that both insulate, or an insulating membrane
///     with a pump), or as solve_laws
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/charging_test.cpp), on an insulating 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp), two spheres act as insulators to 1e-8
/// (tests/physics/coupled_electric_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potentials(const std::vector<ChargingMembrane>& membranes, const Interaction* interaction,
                              double tolerance, std::vector<Vector>& potentials);

}  // namespace vehd
