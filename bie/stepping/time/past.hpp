#pragma once

#include "bie/support/types.hpp"

namespace vehd {

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
