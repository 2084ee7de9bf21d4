#include "bie/stepping/time/step_control.hpp"

#include <algorithm>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

StepControl fixed_steps(double dt) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  return {dt, kSmallestFraction * dt, 0.0};
}

namespace {

/// By which a next step may be larger than its usual margin allows, where the last two steps agree about it: their
/// estimates have then told what the next one will be.
double gain_of_agreement(double before, double found) {
  if (!(before > 0.0)) return 1.0;
  const double agreement = std::min(before, found) / std::max(before, found);
  const double margin = 1.0 - thresholds::margin_of_disagreement * (1.0 - agreement);
  return std::clamp(margin, thresholds::step_safety, thresholds::steady_step_safety) / thresholds::step_safety;
}

}  // namespace

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
      // What a try was rejected for agrees with nothing.
      const double wanted_next = found * (result.rejected == 0 ? gain_of_agreement(state.dt_found, found) : 1.0);
      // A step cut short by an appointment says little against the size that was wanted before.
      const double next = adapts                 ? std::max(wanted_next, wanted_next > dt ? wanted : 0.0)
                          : result.rejected == 0 ? 2.0 * wanted
                                                 : wanted;
      result.state.dt_next = std::min(control.largest, next);
      result.state.dt_found = adapts ? found : 0.0;
      return result;
    }
    ++result.rejected;
    if (!result.too_coarse.empty()) return result;
    from.past.is_continued = result.next_beginning == Beginning::with_past ? 1 : 0;
    wanted = adapts ? dt * std::min(result.factor, thresholds::most_after_rejection) : 0.5 * dt;
  }
  return result;
}

}  // namespace vehd
