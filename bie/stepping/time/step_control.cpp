#include "bie/stepping/time/step_control.hpp"

#include <algorithm>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

StepControl fixed_steps(double dt) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  return {dt, kSmallestFraction * dt, 0.0};
}

double smaller_size(const StepAttempt& rejected) {
  return rejected.dt * std::min(rejected.factor, thresholds::most_after_rejection);
}

void set_next_size(const StepControl& control, const State& start, const StepPlan& plan, StepAttempt& accepted) {
  double next = accepted.rejected == 0 ? 2.0 * plan.wanted : plan.wanted;
  double found = 0.0;
  if (control.tolerance > 0.0) {
    found = accepted.dt * accepted.factor;
    const double trend = start.dt_found > 0.0 ? std::min(1.0, found / start.dt_found) : 1.0;
    // A step cut short by an event says little against the size that was wanted before.
    next = std::max(trend * found, found > accepted.dt ? plan.wanted : 0.0);
  }
  accepted.state.dt_next = std::min(control.largest, next);
  accepted.state.dt_found = found;
}

}  // namespace vehd
