#pragma once

#include "bie/stepping/time/step_attempt.hpp"
#include "bie/stepping/time/step_plan.hpp"

namespace vehd {

/// What rules the size of steps.
struct StepControl {
  double largest = 0.0;    ///< step size
  double smallest = 0.0;   ///< below it no more attempts are made
  double tolerance = 0.0;  ///< of the error estimate; 0: the largest steps, smaller ones only where they fail
};

/// Steps of size dt, halved ten times at most where they fail.
StepControl fixed_steps(double dt);

/// The size to repeat a step with that was not accepted: half where a solve has failed, with a tolerance what suits it.
double smaller_size(const StepAttempt& rejected);

/// Sets the size of the next step in the state of an accepted one. With a tolerance it is what gets on at the least
/// cost, and sizes that fall go on falling: predictive control, Gustafsson (Hairer and Wanner 1996, IV.8). Without one
/// it doubles back towards the largest after every step that was accepted at once.
/// @param start  of the step
void set_next_size(const StepControl& control, const State& start, const StepPlan& plan, StepAttempt& accepted);

}  // namespace vehd
