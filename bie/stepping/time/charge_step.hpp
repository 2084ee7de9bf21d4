#pragma once

#include <vector>

#include "bie/physics/electric.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// What charging changes: V_m of a membrane, or with displacement currents the charges of its faces, and the state of
/// poration: SurfaceFields::transmembrane_potential, SurfaceFields::free_charge and SurfaceFields::poration.
struct Charge {
  Vector potential, free, poration{};
};

/// One implicit step of the charging of all membranes, see charge_membranes and relax_charges.
/// @param at_start  membranes and their interaction
/// @param electric  of each vesicle at the end of the step
/// @param charges   before the step on input, after it on output
SolveReport charge_step(const Model& model, const SolvedFields& at_start,
                        const std::vector<ElectricParameters>& electric, double dt, double tolerance,
                        std::vector<Charge>& charges);

}  // namespace vehd
