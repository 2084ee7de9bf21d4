#pragma once

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/membrane.hpp"
#include "bie/physics/parameters.hpp"

namespace vehd {

/// f_b = −κ_B (Δ_γ H + 2H(H² − K)) n on the upsampled grid, [n_points x 3]; Eq. (2). H enters truncated to degree p;
/// to that accuracy f_b is −δE_b/δx of E_b = κ_B ∫H² dA.
/// Force per area on the fluid, along the normal.
/// Accuracy: spectral; along smooth displacements the slope of E_b to 1e-6 (tests/physics/bending_test.cpp); resultant
/// force and torque below 1e-7 at p = 32 (tests/physics/force_balance_test.cpp)
/// Source: paper Eq. (2); Helfrich 1973
Matrix bending_force(const BendingParameters& bending, const Membrane& membrane);

/// ∫H² dA.
/// Scale-free: 4π on every sphere.
/// Accuracy: spectral; of spheres to 1e-12 (tests/physics/bending_test.cpp)
/// Source: the energy of paper Eq. (2) over κ_B
double bending_energy_scaled(const Surface& surface);

/// First variation of H at material points for a displacement u: h = ½ Δ_γ u·n − b^ab x_a·∂_b u. The first term is Eq.
/// (28b), at fixed metric; the second one accounts for the change of the metric. Without it the implicit response to an
/// ellipsoidal disturbance of a sphere is twice as stiff. Coefficients of h, [n_coefficients].
/// @param to            transform from the upsampled grid to the degree of h
/// @param displacement  u with first and second derivatives on the upsampled grid, each [n_points x 3]
/// Accuracy: spectral; of u = x it is −H to 1e-12, of a rigid motion 0 to 1e-12, differences of H to 1e-6
/// (tests/physics/bending_test.cpp)
/// Source: paper Eq. (28b)
Vector curvature_increment(const Membrane& membrane, const SphereTransform& to, const SphereDerivatives& displacement);

/// −κ_B (Δ_γ h + 2h(H² − K)) n, Eq. (28a), values on the upsampled grid. A spatially varying κ_B is inside the
/// Laplacian.
/// @param increment  h, coefficients [n_coefficients]
/// @return  force per area, [n_points x 3]; linear in h, equal to bending_force if h is the current H
///          (tests/physics/bending_test.cpp)
/// Source: paper Eq. (28a)
Matrix linearised_bending_force(const BendingParameters& bending, const Membrane& membrane, const Vector& increment);

/// Do κ_B and c vary over the membrane? Then elastic_force replaces bending_force and SpontaneousCurvatureEffect.
bool has_varying_bending(const Membrane& membrane);

/// ∫κ_B (H − c)² dA of a membrane with spatially varying elasticity.
/// Accuracy: spectral (tests/physics/varying_membrane_elasticity_test.cpp)
double elastic_energy(const Membrane& membrane);

/// Force per area on the fluid, −δE/δx of E = ∫κ_B (H − c)² dA with κ_B and c fixed to material points. With
/// m = κ_B (H − c):
///   f = −[Δ_γ m + 2m(2H² − K) − 2H m(H − c)] n + (H − c)² ∇_γ κ_B − 2m ∇_γ c.
/// The other terms are tangential: if the membrane slides along itself, other material comes under the same curvature.
/// m enters truncated to degree p, as H in bending_force.
/// @return  values on the upsampled grid, [n_points x 3]
/// Accuracy: spectral; along smooth displacements the slope of E to 1e-5
///           (tests/physics/varying_membrane_elasticity_test.cpp)
/// Source: first variation of Helfrich's energy with coefficients that are functions of the material point; for uniform
/// coefficients paper Eq. (2)
Matrix elastic_force(const Membrane& membrane);

EffectRow bending_row();

}  // namespace vehd
