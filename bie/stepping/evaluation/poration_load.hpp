#pragma once

#include "bie/physics/effects/poration.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// Load of a membrane relative to its criterion of poration.
/// @param criterion    of the membrane
/// @param capacitance  C_m if it is uniform
/// @param fine         with as many longitudes as the degree requires
/// @return             the largest of |V_m|/V_c and (λ + ½ C_m V_m²)/λ_c over the membrane. Of two places that are
///                     equal to rounding the one of positive V_m is taken
/// Accuracy: that of maximum
PorationLoad poration_load(const PorationCriterion& criterion, double capacitance, const SphereTransform& fine,
                           const VesicleState& vesicle, const VesicleSolution& solution, const VesicleFields& fields);

/// Records when and where the criterion is met for the first time.
///
/// The time is that at which the cubic through values and rates of the load at both ends of the step passes 1, or the
/// straight line through the values if the rates are unknown, as for a tension. The place is that of the nearer end.
/// @param before   at the start of the step; null at the start of a run
/// @param arrival  at its end, before a jump there
/// @param after    after that jump; without one equal to `arrival`
/// @param state    at the end of the step: its crossings are set
/// Accuracy: poration time of a sphere to a relative 2e-5 with seven steps in the charging time
/// (tests/stepping/poration_criterion_test.cpp)
void note_first_crossings(const Evaluation* before, double time_before, const Evaluation& arrival,
                          const Evaluation& after, State& state);

/// Writes the crossings of a state up to a time into the diagnostics of that time.
void report_crossings(const State& state, double time, Evaluation& evaluation);

}  // namespace vehd
