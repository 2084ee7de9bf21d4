#pragma once

#include <vector>

#include "bie/stepping/time/events.hpp"
#include "bie/stepping/time/step_attempt.hpp"

/// Control of the step size.
namespace vehd {

/// Limits of the size of steps.
struct StepControl {
  double largest = 0.0;    ///< step size
  double smallest = 0.0;   ///< below it no more attempts are made
  double tolerance = 0.0;  ///< of the error estimate; 0: the largest size, smaller ones only after failures
};

/// Steps of size dt, halved at most ten times if they fail.
StepControl fixed_steps(double dt);

/// First step size with a tolerance, small against the time in which the start changes: half the root of the tolerance,
/// of the order of the scheme, over the fastest rate of any membrane; the largest size if nothing changes.
/// @param state  at the start, evaluated
double first_step(const StepControl& control, int time_order, const Model& model, const State& state,
                  const SolvedFields& solved);

/// Size and end of the next step.
struct StepPlan {
  double dt_next = 0.0;        ///< proposed size: that of a step without events
  double dt = 0.0;             ///< its size
  double event_time = 0.0;     ///< next snapshot, discontinuity or the end
  bool reaches_event = false;  ///< the step ends at event_time
  bool is_snapshot = true;     ///< a snapshot is due at event_time
};

/// Divides the time to the next event into equal steps no longer than `dt_next`, so that no tiny step remains. A
/// remainder within 1e-9 of a whole number of steps counts as whole.
/// Accuracy: steps end on every event to rounding (tests/stepping/time/step_plan_test.cpp)
StepPlan plan_step(double time, double dt_next, const EventTimes& events);

/// Step size with the allowed error, less a margin, over the present size, for an error proportional to dt^power.
/// @param excess  error over the allowed error
double size_factor(double excess, int power);

/// Step size with the least work per unit of time over the present one: a step with j sweeps on M nodes takes 1 + M j
/// evaluations, and its error falls like dt^(j+1), or dt^(j+1+M) with an extrapolation through M nodes.
/// @param excess         error over the allowed error after sweep `fewest_sweeps` and each further one
/// @param extrapolates   the predictor is such an extrapolation
double cheapest_factor(const std::vector<double>& excess, int fewest_sweeps, int n_nodes, bool extrapolates);

/// Size of the next attempt after a rejected one: half if a solve failed, the best size by its error estimate
/// otherwise.
double smaller_size(const StepAttempt& rejected);

/// Sets the size of the next step in the state of an accepted one. With a tolerance: the size with the least work,
/// times the ratio of the last two such sizes if that is below 1 (predictive control, Gustafsson; Hairer and Wanner
/// 1996, IV.8). Without: twice the size after a step accepted at the first attempt, up to the largest.
/// @param start  of the step
void set_next_size(const StepControl& control, const State& start, const StepPlan& plan, StepAttempt& accepted);

}  // namespace vehd
