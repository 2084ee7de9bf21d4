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
  State from = state;
  double wanted = std::min(state.dt_next, control.largest);
  while (wanted >= control.smallest) {
    // A limit that is the wanted step up to rounding is taken exactly: the caller has an appointment there.
    const double dt = dt_limit <= wanted * (1.0 + kRounding) ? dt_limit : wanted;
    const StepAttempt former = std::move(result);
    result = attempt_step(model, discretisation, from, at_start, dt, instruments, goal);
    result.add_work_of(former);
    if (result.accepted) {
      const double found = dt * result.factor;
      // Sizes that fall go on falling: predictive control, Gustafsson (Hairer and Wanner 1996, IV.8).
      const double trend = state.dt_found > 0.0 ? std::min(1.0, found / state.dt_found) : 1.0;
      // A step cut short by an appointment says little against the size that was wanted before.
      const double next = adapts                 ? std::max(trend * found, found > dt ? wanted : 0.0)
                          : result.rejected == 0 ? 2.0 * wanted
                                                 : wanted;
      result.state.dt_next = std::min(control.largest, next);
      result.state.dt_found = adapts ? found : 0.0;
      return result;
    }
    ++result.rejected;
    // What repeated tries do not get over may be the extrapolation.
    if (result.rejected == thresholds::most_tries_from_past) from = without_past(std::move(from));
    wanted = adapts ? dt * std::min(result.factor, thresholds::most_after_rejection) : 0.5 * dt;
  }
  return result;
}

}  // namespace vehd
