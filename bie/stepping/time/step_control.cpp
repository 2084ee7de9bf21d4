#include "bie/stepping/time/step_control.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

/// dt times this factor would be wrong by the tolerance: the estimate is of the order of the step's last correction.
double size_factor(double estimate, double tolerance, int order) {
  if (estimate <= 0.0) return thresholds::most_step_factor;
  return std::clamp(thresholds::step_safety * std::pow(tolerance / estimate, 1.0 / order),
                    thresholds::least_step_factor, thresholds::most_step_factor);
}

/// Vesicles whose degree is what is wrong with a step that gains nothing by being smaller than a former one: much of
/// the estimate is what it took to hold area and volume on the grid that was moved.
std::vector<std::size_t> too_coarse(const Discretisation& discretisation, const StepAttempt& former,
                                    const StepAttempt& attempt) {
  std::vector<std::size_t> result;
  const bool gains = attempt.error_estimate <= thresholds::stagnation * former.error_estimate;
  if (gains || former.error_estimate == 0.0) return result;
  for (std::size_t a = 0; a < attempt.arrival_shifts.size(); ++a) {
    const bool can_rise = discretisation.vesicle(a).order() < discretisation.settings().order;
    if (can_rise && attempt.arrival_shifts[a] > thresholds::arrival_share * attempt.error_estimate) result.push_back(a);
  }
  return result;
}

}  // namespace

StepControl fixed_steps(double dt) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  return {dt, kSmallestFraction * dt, 0.0};
}

StepAttempt controlled_step(const Model& model, const Discretisation& discretisation, const State& state,
                            const SolvedFields& at_start, const StepControl& control, double dt_limit,
                            Instruments& instruments) {
  constexpr double kRounding = 1e-9;
  const int order = discretisation.settings().time_order;
  const bool adapts = control.tolerance > 0.0;
  StepAttempt result;
  double wanted = std::min(state.dt_next, control.largest);
  while (wanted >= control.smallest) {
    // A limit that is the wanted step up to rounding is taken exactly: the caller has an appointment there.
    const double dt = dt_limit <= wanted * (1.0 + kRounding) ? dt_limit : wanted;
    const StepAttempt former = std::move(result);
    result = attempt_step(model, discretisation, state, at_start, dt, instruments);
    result.rejected = former.rejected;
    result.iterations_flow += former.iterations_flow;
    result.iterations_electric += former.iterations_electric;
    const double factor = adapts ? size_factor(result.error_estimate, control.tolerance, order) : 2.0;
    const bool solved = result.accepted;
    result.accepted = solved && (!adapts || result.error_estimate <= control.tolerance);
    if (result.accepted) {
      // A step cut short by an appointment says little against the size that was wanted before.
      const double next = adapts                 ? std::max(dt * factor, factor > 1.0 ? wanted : 0.0)
                          : result.rejected == 0 ? factor * wanted
                                                 : wanted;
      result.state.dt_next = std::min(control.largest, next);
      return result;
    }
    ++result.rejected;
    if (solved) {
      result.reason = fmt::format("the last correction of a step changes it by {:.1e}; accepted: {:.1e}",
                                  result.error_estimate, control.tolerance);
      result.too_coarse = too_coarse(discretisation, former, result);
      if (!result.too_coarse.empty()) return result;
    }
    wanted = solved ? dt * std::min(factor, 0.9) : 0.5 * dt;
  }
  return result;
}

}  // namespace vehd
