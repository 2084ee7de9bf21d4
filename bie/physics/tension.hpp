#pragma once

#include "bie/physics/effect.hpp"
#include "bie/physics/membrane.hpp"

namespace vehd {

/// f_λ = λ Δ_γ x + ∇_γ λ = 2Hλ n + ∇_γ λ on the upsampled grid, [n_points x 3]; Eq. (2).
Matrix tension_force(const Membrane& membrane, const Vector& tension);

/// Coefficients of J ∇_γ·u, the left side of the inextensibility constraint (27b). The weight makes the entry of
/// degree 0 the rate of change of the whole area.
Vector weighted_divergence(const Membrane& membrane, const SphereDerivatives& velocity);

EffectDescription tension_description();

}  // namespace vehd
