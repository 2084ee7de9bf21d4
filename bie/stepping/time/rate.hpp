#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/evaluation/tension_difference.hpp"

namespace vehd {

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

}  // namespace vehd
