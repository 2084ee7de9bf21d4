#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// A past that can be continued: of each degree as many of the latest times as tell a smooth motion. A polynomial
/// magnifies what is wrong with the values it goes through, the more the higher its degree is. Where the motion is
/// smooth each further time adds less than the one before. What adds more is rounding and what solvers leave: earlier
/// values become those of the polynomial through the later ones. Judged as far ahead as the past is long.
/// @param times  of the past, less now: ascending, below zero
/// @param past   see VesicleState: columns of x and of the scalars at each time, one time behind the other
Matrix smooth_past(const Vector& times, Matrix past);

}  // namespace vehd
