#pragma once

#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Largest difference of coefficients of x and of V_m, each over its largest coefficient.
double state_difference(const State& state, const State& reference);

}  // namespace vehd
