#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/stepper.hpp"

namespace vehd {

namespace {

/// dt times this factor would have changed by the tolerance: the change is of the order of the step's last correction.
double size_factor(double change, double tolerance, int order) {
  constexpr double kSafety = 0.85;
  constexpr double kLeast = 0.2;
  constexpr double kMost = 4.0;
  if (change <= 0.0) return kMost;
  return std::clamp(kSafety * std::pow(tolerance / change, 1.0 / order), kLeast, kMost);
}

}  // namespace

StepControl fixed_steps(double dt) {
  constexpr double kSmallestFraction = 1.0 / 1024.0;
  return {dt, kSmallestFraction * dt, 0.0};
}

Advance advance(const Model& model, const Discretisation& discretisation, const State& state,
                const Evaluation& evaluation, const StepControl& control, double dt_limit, Instruments& instruments) {
  constexpr double kRounding = 1e-9;
  const int order = discretisation.settings().time_order;
  Advance result;
  double wanted = std::min(state.dt_next, control.largest);
  while (wanted >= control.smallest) {
    // A limit that is the wanted step up to rounding is taken exactly: the caller has an appointment there.
    const double dt = dt_limit <= wanted * (1.0 + kRounding) ? dt_limit : wanted;
    const StepResult attempt = step(model, discretisation, state, evaluation, dt, instruments);
    result.iterations_flow += attempt.iterations_flow;
    result.iterations_electric += attempt.iterations_electric;
    const bool exact_enough = control.tolerance == 0.0 || attempt.change <= control.tolerance;
    const double factor = control.tolerance == 0.0 ? 2.0 : size_factor(attempt.change, control.tolerance, order);
    if (attempt.accepted && exact_enough) {
      result.accepted = true;
      result.state = attempt.state;
      result.dt = dt;
      result.change = attempt.change;
      result.raw_area = attempt.raw_area;
      if (control.tolerance > 0.0) {
        // A step cut short by an appointment says little against the size that was wanted before.
        result.state.dt_next = std::max(dt * factor, factor > 1.0 ? wanted : 0.0);
      } else {
        result.state.dt_next = result.rejected == 0 ? factor * wanted : wanted;
      }
      result.state.dt_next = std::min(control.largest, result.state.dt_next);
      return result;
    }
    ++result.rejected;
    if (attempt.accepted) {
      result.reason = fmt::format("the last correction of a step changes it by {:.1e}; accepted: {:.1e}",
                                  attempt.change, control.tolerance);
      wanted = dt * std::min(factor, 0.9);
    } else {
      result.reason = attempt.reason;
      wanted = 0.5 * dt;
    }
  }
  return result;
}

}  // namespace vehd
