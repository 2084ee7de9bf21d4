#pragma once

#include <vector>

#include "bie/physics/effects/effect.hpp"
#include "bie/physics/membrane.hpp"

namespace vehd {

/// A potential between the membranes of different vesicles, E = Σ_{a<b} ∫∫ w(|x − y|) dA_b dA_a with
///   w(r) = energy/(π range²) exp(−r²/range²):
/// two flat membranes at distance d have energy · exp(−d²/range²) per area. Positive energies repel, negative attract.
struct ContactParameters {
  double energy = 0.0;  ///< per area of two flat membranes in contact
  double range = 1.0;
};

/// One of the interacting membranes.
struct ContactMembrane {
  const Matrix& position;  ///< coefficients of x, [n_coefficients x 3]
  const Membrane& membrane;
};

/// Force −δE/δx of each membrane on the fluid per area, values on its upsampled grid, [n_points x 3]: (2HW − ∂W/∂n) n
/// with W(x) = Σ_b ∫ w dA_b over all other membranes. The potential is cut off at a distance of six ranges.
/// @throws ConvergenceError if the range is too short for the finest grid
/// Accuracy: quadrature to 1e-9 of the largest force; slope of the energy to 1e-6 (tests/physics/contact_test.cpp)
std::vector<Matrix> contact_forces(const ContactParameters& contact, const std::vector<ContactMembrane>& membranes);

/// The energy E of all pairs.
/// Accuracy: that of contact_forces
double contact_energy(const ContactParameters& contact, const std::vector<ContactMembrane>& membranes);

EffectRow contact_row();

}  // namespace vehd
