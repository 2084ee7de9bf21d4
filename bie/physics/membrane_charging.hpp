#pragma once

#include "bie/linear/solve_report.hpp"
#include "bie/physics/electric.hpp"

namespace vehd {

/// V_m after one backward-Euler step of (4e)/(14), Eq. (30), in one solve at every contrast and time constant:
/// with a = C_m/dt + G_m, b = (C_m/dt) V_m, κ = σ_i σ_e/(σ_i + σ_e), the unknown V obeys
///   (½ + ηS′)(a V − b) − κ D′[V] = κ E·n.
/// @param potential  V_m before the step on input, after it on output
/// @param dt         > 0
/// @param tolerance  of the preconditioned residual, relative
/// Accuracy: first order in dt, spectral in space; each step on the sphere is backward Euler to 1e-11
/// (tests/physics/charging_test.cpp)
/// Source: paper Eqs. (14), (29), (30), without the inverse
SolveReport charge_membrane(const ElectricParameters& electric, const ChargingParameters& charging,
                            const Membrane& membrane, double dt, double tolerance, Vector& potential);

/// Steady V_m: C_m/dt → 0 in charge_membrane.
/// @throws InputError if nothing determines it (a membrane and a fluid that both insulate)
/// @param potential  a first guess on input, the steady V_m on output
/// Accuracy: spectral; on the sphere to 1e-11 (tests/physics/charging_test.cpp), on an insulating 2:1 prolate to 1e-10
/// (tests/physics/electric_prolate_test.cpp)
/// Source: paper Eq. (14) without its first term
SolveReport steady_potential(const ElectricParameters& electric, const ChargingParameters& charging,
                             const Membrane& membrane, double tolerance, Vector& potential);

}  // namespace vehd
