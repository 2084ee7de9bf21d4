#pragma once

#include <algorithm>
#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// A tension over the membrane that has it; both 0 where there is none, or a sphere leaves its mean open.
struct TensionIntegrals {
  double sum = 0.0;        ///< ∫λ dA
  double magnitude = 0.0;  ///< ∫|λ| dA
};

/// F = dy/dt at one node, with what is solved for at once there and a history tells of.
struct Rate {
  struct Instantaneous {
    Matrix charge;               ///< q, or its amplitude, coefficients; empty without electricity
    Matrix potential_amplitude;  ///< of V_m in an averaged field; empty without
    TensionIntegrals tension;
  };
  std::vector<Unknowns> unknowns;  ///< of each vesicle, of material points; what does not change is empty
  std::vector<Instantaneous> instantaneous;
};

/// Of what was solved for at a node.
Rate rate_of(const SolvedFields& solved);

/// How two rates of one node differ in what is solved for at once, the largest of all vesicles.
struct InstantaneousDifference {
  double tension = 0.0;  ///< of ∫λ dA, over ∫|λ| dA
  double charge = 0.0;   ///< of q in the maximum norm, over its size, and of V_m where it is solved for at once

  [[nodiscard]] double largest() const { return std::max(tension, charge); }
};

/// Tensions and charges that are small against those of the bending modulus and of the field count as if they were
/// larger.
/// @param grids  a solution with membranes of the degrees of b; a may have lower ones
InstantaneousDifference instantaneous_difference(const Model& model, const SolvedFields& grids, const Rate& a,
                                                 const Rate& b);

}  // namespace vehd
