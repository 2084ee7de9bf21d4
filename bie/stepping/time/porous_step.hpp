#pragma once

#include <vector>

#include "bie/stepping/time/charge_step.hpp"

namespace vehd {

/// One implicit step of the charging of membranes that porate and of what makes them conduct, see
/// charge_porous_membranes and relax_porous_membranes.
/// @param at_start  membranes and their interaction; where their electric part is inactive pores close, and no more
/// @param electric  of each vesicle at the end of the step; empty where the electric part is inactive
/// @param from      what the step starts from, or what a node has now
/// @param lacks     what the node lacks of its equation; null for a step of backward Euler
/// @param reached   at the end
SolveReport porous_step(const Model& model, const SolvedFields& at_start,
                        const std::vector<ElectricParameters>& electric, double dt, double tolerance,
                        const std::vector<Charge>& from, const std::vector<Charge>* lacks,
                        std::vector<Charge>& reached);

}  // namespace vehd
