#pragma once

#include "bie/support/types.hpp"

namespace vehd {

/// Of each degree n what a field can be at most: max |f_n| ≤ |coefficients of degree n| √((2n+1)/4π), by the addition
/// theorem.
/// @param coefficients  [n_coefficients x F]; of vectors the norm is bounded
Vector degree_bounds(const Matrix& coefficients);

}  // namespace vehd
