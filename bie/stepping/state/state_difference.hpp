#pragma once

#include "bie/stepping/state/state.hpp"

namespace vehd {

/// Largest difference of coefficients of x and of V_m, each over its largest coefficient.
/// @return  a share; both states must have the same degrees
double state_difference(const State& state, const State& reference);

}  // namespace vehd
