#include "bie/stepping/time/step_plan.hpp"

#include <cmath>

namespace vehd {
namespace {

/// Of a step.
constexpr double kStepRounding = 1e-9;

}  // namespace

StepPlan plan_step(double time, double wanted, const EventTimes& events) {
  StepPlan plan{.wanted = wanted};
  plan.event_time = events.snapshots.next(time, events.end_time).value_or(events.end_time);
  // A discontinuity within rounding of a snapshot is that snapshot.
  if (events.discontinuity && *events.discontinuity < plan.event_time - kStepRounding * wanted) {
    plan.event_time = *events.discontinuity;
    plan.is_snapshot = false;
  }
  const double distance = plan.event_time - time;
  const double n_steps = std::fmax(1.0, std::ceil(distance / wanted - kStepRounding));
  plan.dt = distance / n_steps;
  plan.reaches_event = n_steps == 1.0;
  return plan;
}

}  // namespace vehd
