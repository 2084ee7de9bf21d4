#pragma once

#include "bie/stepping/time/node_solution.hpp"

namespace vehd {

/// Whether a step of this size is short enough to extrapolate the past of a state: at most longest_extrapolation times
/// the last one.
bool can_extrapolate(const State& state, double dt);

/// The polynomial through the nodes of the last step and the start of this one, at a time after it. Nothing is solved
/// for, and no constraint holds but for what its error leaves. Only where `can_extrapolate`.
/// Accuracy: of order one more than there are times in the past (tests/stepping/time/past_test.cpp)
NodeSolution extrapolated(const StepStart& start, double time);

/// Makes the start and the nodes before the last the past of the state at the last one; collective. A rigid sphere
/// turns on the spot, which no polynomial follows as exactly as its own motion: with one there is no past.
/// @param nodes  the last one remapped
void store_past(const StepStart& start, const std::vector<NodeSolution>& nodes, State& state);

/// A past that can be extrapolated: of each degree as many of the latest times as belong to a smooth motion. A
/// polynomial magnifies the errors of the values it goes through, the more the higher its degree is. Where the motion
/// is smooth each further time adds less than the one before, judged as far ahead as the past is long. What adds more
/// is rounding and the errors of solvers: earlier values become those of the polynomial through the later ones.
/// @param times  of the past, minus the present: ascending, below zero, [n_times]
/// @param past   see VesicleState: columns of x and of the scalars at each time, one time behind the other,
///               [n_coefficients x n_columns n_times]
/// @return       of the same shape
Matrix smooth_past(const Vector& times, Matrix past);

}  // namespace vehd
