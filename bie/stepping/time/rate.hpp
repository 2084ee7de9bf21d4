#pragma once

#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/evaluation/tension_difference.hpp"

namespace vehd {

/// F = dy/dt of material points, coefficients; a part that does not change is empty. With it what was solved for on the
/// way and a history tells of.
struct Rate {
  struct OfVesicle {
    Matrix velocity;
    Vector potential;
    Vector free_charge;          ///< of SurfaceFields::free_charge; empty without
    Vector poration;             ///< of SurfaceFields::poration; empty without
    Matrix charge;               ///< q, or its amplitude; empty without electricity
    Matrix potential_amplitude;  ///< of V_m in an averaged field, which is solved for at once; empty without
    TensionIntegrals tension;
  };
  std::vector<OfVesicle> vesicles;
};

/// Of what was solved for at a node.
Rate rate_of(const SolvedFields& solved);

}  // namespace vehd
