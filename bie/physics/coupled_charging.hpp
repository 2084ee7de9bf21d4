#pragma once

#include <vector>

#include "bie/physics/coupled_electric.hpp"
#include "bie/physics/membrane_charging.hpp"

namespace vehd {

/// charge_membrane for several membranes at once: with g_b = (a_b V_b − b_b)/κ_b the unknowns V obey
///   ½ g_a + Σ_b η_b S′_ab[g_b] − Σ_b D′_ab[V_b] = E·n on every membrane a.
/// @param charging    of each membrane
/// @param potentials  V_m of each before the step on input, after it on output
/// @throws InputError if a membrane that carries charge lies between fluids of which one insulates: g is not known from
///     V there
/// Accuracy: first order in dt, spectral in space; the multipoles of two spheres charge as their linear system says
/// (tests/physics/coupled_electric_test.cpp)
/// Source: paper Eqs. (14), (29), (30), without the inverse, the layers being those of all membranes
SolveReport charge_membranes(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                             const std::vector<ChargingParameters>& charging, double dt, double tolerance,
                             std::vector<Vector>& potentials);

/// solve_varying_charging for several membranes at once.
/// @throws InputError as charge_membranes
/// @param steps       a and b of each
/// @param potentials  where the solve starts on input, V of each on output
SolveReport solve_varying_charging(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                                   std::vector<ChargingStep> steps, double tolerance, std::vector<Vector>& potentials);

/// steady_potential for several membranes at once.
/// @throws InputError if nothing determines it, or as charge_membranes
/// @param potentials  of each, first guesses on input; empty ones are zero
/// Accuracy: spectral; two spheres act as insulators to 1e-8 (tests/physics/coupled_electric_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potentials(const std::vector<ElectricMembrane>& membranes, const Interaction& interaction,
                              const std::vector<ChargingParameters>& charging, double tolerance,
                              std::vector<Vector>& potentials);

}  // namespace vehd
