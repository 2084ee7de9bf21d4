#include "bie/stepping/time/step_plan.hpp"

#include <cmath>

namespace vehd {
namespace {

/// Of a step.
constexpr double kStepRounding = 1e-9;

}  // namespace

StepPlan plan_step(double time, double dt, const EventTimes& events) {
  StepPlan plan;
  plan.event_time = events.snapshots.next(time, events.end_time).value_or(events.end_time);
  // A discontinuity within rounding of a snapshot is that snapshot.
  if (events.discontinuity && *events.discontinuity < plan.event_time - kStepRounding * dt) {
    plan.event_time = *events.discontinuity;
    plan.is_snapshot = false;
  }
  const double distance = plan.event_time - time;
  const double n_steps = std::fmax(1.0, std::ceil(distance / dt - kStepRounding));
  plan.dt_limit = distance / n_steps;
  plan.reaches_event = n_steps == 1.0;
  return plan;
}

}  // namespace vehd
