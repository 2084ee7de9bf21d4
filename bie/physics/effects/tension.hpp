#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/membrane.hpp"

namespace vehd {

/// f_λ = λ Δ_γ x + ∇_γ λ = 2Hλ n + ∇_γ λ on the upsampled grid, [n_points x 3]; Eq. (2).
/// @param tension  coefficients of λ, force per length; λ > 0 pulls inwards on a sphere
/// Accuracy: spectral; the slope of the energy of a frozen tension to 1e-6 (tests/physics/tension_test.cpp); resultant
/// force and torque below 1e-13 (tests/physics/force_balance_test.cpp)
/// Source: paper Eq. (2)
Matrix tension_force(const Membrane& membrane, const Vector& tension);

/// Coefficients of J ∇_γ·u, the left side of the inextensibility constraint (27b). The weight makes the entry of
/// degree 0 the rate of change of the whole area.
/// @param velocity  with first derivatives, on the upsampled grid
/// @return          [n_coefficients]
/// Accuracy: spectral; the rate of change of J to 1e-8 (tests/physics/tension_test.cpp)
/// Source: paper Eqs. (1e), (27b)
Vector weighted_divergence(const Membrane& membrane, const SphereDerivatives& velocity);

/// ∫λ dA / ∫dA.
/// @param fine     degree of λ ↔ points of the surface
/// @param tension  λ, coefficients [n_coefficients]
double mean_tension(const SphereTransform& fine, const Surface& surface, const Vector& tension);

/// Mean of ∇_γ·u over the area, which is the relative rate of change of the area.
/// @param velocity  coefficients, [n_coefficients x 3]
double dilation(const Membrane& membrane, const Matrix& velocity);

EffectRow tension_row();

}  // namespace vehd
