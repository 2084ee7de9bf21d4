#include "bie/stepping/time/step_control.hpp"

#include <algorithm>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

StepControl fixed_steps(double dt) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  return {dt, kSmallestFraction * dt, 0.0};
}

StepAttempt controlled_step(const Model& model, const Discretisation& discretisation, const State& state,
                            const SolvedFields& at_start, const StepControl& control, double dt_limit,
                            Instruments& instruments, const StepGoal* goal) {
  constexpr double kRounding = 1e-9;
  const bool adapts = goal != nullptr;
  StepAttempt result;
  double wanted = std::min(state.dt_next, control.largest);
  while (wanted >= control.smallest) {
    // A limit that is the wanted step up to rounding is taken exactly: the caller has an appointment there.
    const double dt = dt_limit <= wanted * (1.0 + kRounding) ? dt_limit : wanted;
    const StepAttempt former = std::move(result);
    result = attempt_step(model, discretisation, state, at_start, dt, instruments, goal);
    result.add_work_of(former);
    if (result.accepted) {
      // A step cut short by an appointment says little against the size that was wanted before.
      const double next = adapts                 ? std::max(dt * result.factor, result.factor > 1.0 ? wanted : 0.0)
                          : result.rejected == 0 ? 2.0 * wanted
                                                 : wanted;
      result.state.dt_next = std::min(control.largest, next);
      return result;
    }
    ++result.rejected;
    if (!result.too_coarse.empty()) return result;
    wanted = adapts ? dt * std::min(result.factor, thresholds::most_after_rejection) : 0.5 * dt;
  }
  return result;
}

}  // namespace vehd
