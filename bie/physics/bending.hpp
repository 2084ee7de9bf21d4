#pragma once

#include "bie/physics/effect.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// f_b = −κ_B (Δ_γ H + 2H(H² − K)) n on the upsampled grid, [n_points x 3]; Eq. (2). H enters truncated to degree p;
/// to that accuracy f_b is −δE_b/δx of E_b = κ_B ∫H² dA.
Matrix bending_force(const BendingParameters& bending, const Membrane& membrane);

/// ∫H² dA.
double bending_energy_scaled(const Surface& surface);

/// Linearised change of H for a displacement u, Eq. (28b) in the coordinate-free form H = ½ Δ_γ x·n with the
/// geometry frozen: h = ½ Δ_γ u·n. Coefficients of degree p from the Hessian of u on the upsampled grid.
Vector curvature_increment(const Membrane& membrane, const SphereDerivatives& displacement);

/// −κ_B (Δ_γ h + 2h(H² − K)) n, Eq. (28a), for coefficients h of degree p; values on the upsampled grid.
Matrix linearised_bending_force(const BendingParameters& bending, const Membrane& membrane, const Vector& increment);

EffectDescription bending_description();

}  // namespace vehd
