#pragma once

#include "bie/physics/membrane.hpp"
#include "bie/stepping/fields.hpp"
#include "bie/stepping/state.hpp"

namespace vehd {

/// History quantities of a state. Extrema are those of the surface between the nodes to third order in the spacing.
Diagnostics diagnose(const State& state, const Membrane& membrane, const Fields& fields);

}  // namespace vehd
