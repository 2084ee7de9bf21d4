#pragma once

#include "bie/stepping/time/node_solution.hpp"

namespace vehd {

/// Whether a step of this size is short enough to extrapolate the past of a state: at most longest_extrapolation times
/// the last one.
bool can_extrapolate(const State& state, double dt);

/// Value, at a time after the start of this step, of the polynomial through it and the nodes of the last step. Nothing
/// is solved, and constraints hold only up to its error. Requires `can_extrapolate`.
/// Accuracy: of order one more than there are times in the past (tests/stepping/time/past_test.cpp)
NodeSolution extrapolated(const StepStart& start, double time);

/// Makes the start and the nodes before the last the past of the state at the last one; collective. With a rigid sphere
/// no past is stored: it turns on the spot, which no polynomial follows as accurately as its own motion.
/// @param nodes  the last one remapped
void store_past(const StepStart& start, const std::vector<NodeSolution>& nodes, State& state);

/// A past that can be extrapolated: for each degree, only the latest times that belong to a smooth motion count. A
/// polynomial amplifies the errors of its values, the more the higher its degree. In a smooth motion each further time
/// changes the extrapolation over the length of the past by less than the one before. A larger change is due to
/// rounding and errors of solves: the earlier values are then replaced by the polynomial through the later ones.
/// @param times  of the past, minus the present: ascending, below zero, [n_times]
/// @param past   see VesicleState: columns of x and of the scalars at each time, one time after the other,
///               [n_coefficients x n_columns n_times]
/// @return       of the same shape
Matrix smooth_past(const Vector& times, Matrix past);

}  // namespace vehd
