#pragma once

#include "bie/physics/effects/poration.hpp"
#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// How near a membrane is to its criterion of poration.
/// @param criterion    of the membrane
/// @param capacitance  C_m where it is the same everywhere
/// @param fine         whose grid has as many longitudes as the degree asks for
/// @return             the largest of |V_m|/V_c and (λ + ½ C_m V_m²)/λ_c over the membrane. Where two places are equal
///                     to rounding the one of positive V_m is taken
/// Accuracy: that of maximum
PorationLoad poration_load(const PorationCriterion& criterion, double capacitance, const SphereTransform& fine,
                           const VesicleState& vesicle, const VesicleSolution& solution, const VesicleFields& fields);

/// Notes where the criterion is met for the first time.
///
/// A load of |V_m| passes 1 where the cubic through its values and rates at both ends of the step does, and where its
/// rates are not known, as those of a tension, the straight line between its values. The place is that of the nearer
/// end.
/// @param before   at the start of the step; null at the start of a run
/// @param arrival  at its end, before a jump there
/// @param after    after that jump, or the same again
/// @param state    at the end of the step: its crossings are set
/// Accuracy: t_p of a sphere to 2e-5 of it with seven steps in the charging time
/// (tests/stepping/poration_criterion_test.cpp)
void note_first_crossings(const Evaluation* before, double time_before, const Evaluation& arrival,
                          const Evaluation& after, State& state);

/// Writes the crossings of a state up to a time into the diagnostics of that time.
void report_crossings(const State& state, double time, Evaluation& evaluation);

}  // namespace vehd
