#pragma once

#include "bie/physics/membrane.hpp"

namespace vehd {

/// Do κ_B and c differ from place to place? Then the forces of this file take the place of bending_force and of
/// SpontaneousCurvatureEffect.
bool bends_by_place(const Membrane& membrane);

/// ∫κ_B (H − c)² dA of a membrane with spatially varying elasticity.
/// Accuracy: spectral (tests/physics/elasticity_by_place_test.cpp)
double elastic_energy(const Membrane& membrane);

/// Force per area on the fluid, −δE/δx of E = ∫κ_B (H − c)² dA with κ_B and c that ride on the material. With
/// m = κ_B (H − c):
///   f = −[Δ_γ m + 2m(2H² − K) − 2H m(H − c)] n + (H − c)² ∇_γ κ_B − 2m ∇_γ c.
/// The second part is tangential: sliding along itself, the membrane brings other material under the same curvature.
/// m enters truncated to the degree p, as H does in bending_force.
/// @return  values on the upsampled grid, [n_points x 3]
/// Accuracy: spectral; along smooth displacements the slope of E to 1e-5 (tests/physics/elasticity_by_place_test.cpp)
/// Source: first variation of Helfrich's energy with coefficients that are functions of the material point; with
/// uniform ones paper Eq. (2)
Matrix elastic_force(const Membrane& membrane);

}  // namespace vehd
