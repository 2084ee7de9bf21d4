#pragma once

#include "bie/stepping/time/step_attempt.hpp"

namespace vehd {

/// What rules the size of steps.
struct StepControl {
  double largest = 0.0;    ///< step size
  double smallest = 0.0;   ///< below it no more attempts are made
  double tolerance = 0.0;  ///< of the error estimate; 0: the largest steps, smaller ones only where they fail
};

/// Steps of size dt, halved ten times at most where they fail.
StepControl fixed_steps(double dt);

/// One accepted step of size at most dt_limit, with dt_next set, or the reason why there is none. Tries
/// min(state.dt_next, dt_limit); halves after every failure. With a tolerance, an attempt that leaves more than the
/// goal allows is repeated in a smaller size, and dt_next is what gets on at the least cost; without one, dt_next
/// doubles back towards the largest after every success.
/// @param goal  of a tolerance; null without one
StepAttempt controlled_step(const Model& model, const Discretisation& discretisation, const State& state,
                            const SolvedFields& at_start, const StepControl& control, double dt_limit,
                            Instruments& instruments, const StepGoal* goal = nullptr);

}  // namespace vehd
