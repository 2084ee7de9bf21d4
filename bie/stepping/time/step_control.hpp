#pragma once

#include "bie/stepping/time/step_attempt.hpp"
#include "bie/stepping/time/step_plan.hpp"

namespace vehd {

/// Limits of the size of steps.
struct StepControl {
  double largest = 0.0;    ///< step size
  double smallest = 0.0;   ///< below it no more attempts are made
  double tolerance = 0.0;  ///< of the error estimate; 0: the largest size, smaller ones only after failures
};

/// Steps of size dt, halved ten times at most where they fail.
StepControl fixed_steps(double dt);

/// Size of the next attempt after a rejected one: half if a solve failed, the best size by its error estimate
/// otherwise.
double smaller_size(const StepAttempt& rejected);

/// Sets the size of the next step in the state of an accepted one. With a tolerance: the size with the least work,
/// times the ratio of the last two such sizes where that is below 1 (predictive control, Gustafsson; Hairer and Wanner
/// 1996, IV.8). Without: twice the size after a step that was accepted at once, up to the largest.
/// @param start  of the step
void set_next_size(const StepControl& control, const State& start, const StepPlan& plan, StepAttempt& accepted);

}  // namespace vehd
