#pragma once

#include "bie/stepping/evolution.hpp"

namespace vehd {

/// A first step with a tolerance, small against the time in which the start changes: a share of the tolerance's root,
/// thresholds::first_step_share, over the fastest rate of any membrane; the largest step where nothing changes.
/// @param state  at the start, evaluated
double first_step(const EvolutionSetup& setup, const Evaluation& evaluation, const State& state);

}  // namespace vehd
