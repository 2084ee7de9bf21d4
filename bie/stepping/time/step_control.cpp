#include "bie/stepping/time/step_control.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/physics/electric.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/thresholds.hpp"

namespace vehd {

namespace {

/// An event within this share of a step from its end is at its end.
constexpr double step_rounding = 1e-9;
/// Smallest step without a tolerance, over the largest: ten halvings.
constexpr double smallest_fraction = 1.0 / 1024.0;
/// The first step covers this share of the time in which the start changes by the root of the tolerance.
constexpr double first_step_share = 0.5;
/// Safety factor of the next size, as in textbooks: the estimate is only of leading order.
constexpr double step_safety = 0.75;
/// Limits of the ratio of successive sizes.
constexpr double least_step_factor = 0.2, most_step_factor = 4.0;
/// Largest size after an attempt that was not accurate enough, and size after failed solves, over that of the attempt.
constexpr double most_after_rejection = 0.9, size_after_failure = 0.5;

/// Rate at which a pump charges a membrane without V_m and field, whose V_m has no scale yet; else 0.
double pumped_rate(const Model& model, const VesicleModel& vesicle, const VesicleState& state) {
  if (!vesicle.pump || !model.electric->field.isZero(0.0) || !state.transmembrane_potential.isZero(0.0)) return 0.0;
  const double series = series_conductivity(electric_parameters(model, vesicle));
  return (vesicle.charging.conductance + series / state.radius()) / vesicle.charging.capacitance;
}

/// Rate at which one membrane changes at the start, relative to its size.
double starting_rate(const Model& model, const VesicleModel& vesicle, const VesicleState& state,
                     const VesicleFields& fields, const VesicleSolution& solution) {
  double rate = 0.0;
  // Degree 0 only translates the membrane.
  const Matrix& velocity = fields.velocity;
  if (velocity.size() > 0) rate = velocity.bottomRows(velocity.rows() - 1).norm() / state.radius();
  const Vector& of_potential = solution.rate.transmembrane_potential;
  if (of_potential.size() == 0) return rate;
  if (const double pumped = pumped_rate(model, vesicle, state); pumped > 0.0) return std::max(rate, pumped);
  const double scale = potential_scale(*model.electric, state.radius(), state.transmembrane_potential.norm());
  return std::max(rate, of_potential.norm() / scale);
}

}  // namespace

StepControl fixed_steps(double dt) { return {dt, smallest_fraction * dt, 0.0}; }

double first_step(const StepControl& control, int time_order, const Model& model, const State& state,
                  const SolvedFields& solved) {
  double rate = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    rate = std::max(rate, starting_rate(model, model.vesicles[a], state.vesicles[a], solved.fields.vesicles[a],
                                        solved.vesicles[a]));
  }
  const double share = first_step_share * std::pow(control.tolerance, 1.0 / time_order);
  return rate > 0.0 ? std::min(share / rate, control.largest) : control.largest;
}

StepPlan plan_step(double time, double dt_next, const EventTimes& events) {
  StepPlan plan{.dt_next = dt_next};
  plan.event_time = events.snapshots.next(time, events.end_time).value_or(events.end_time);
  // A discontinuity that differs from a snapshot only by rounding counts as that snapshot.
  if (events.discontinuity && *events.discontinuity < plan.event_time - step_rounding * dt_next) {
    plan.event_time = *events.discontinuity;
    plan.is_snapshot = false;
  }
  const double distance = plan.event_time - time;
  const double n_steps = std::fmax(1.0, std::ceil(distance / dt_next - step_rounding));
  plan.dt = distance / n_steps;
  plan.reaches_event = n_steps == 1.0;
  return plan;
}

double size_factor(double excess, int power) {
  if (excess <= 0.0) return most_step_factor;
  return std::clamp(step_safety * std::pow(excess, -1.0 / power), least_step_factor, most_step_factor);
}

double cheapest_factor(const std::vector<double>& excess, int fewest_sweeps, int n_nodes, bool extrapolates) {
  double best = least_step_factor, least_cost = std::numeric_limits<double>::infinity();
  int sweeps = fewest_sweeps;
  for (const double of_sweeps : excess) {
    const double factor = size_factor(of_sweeps, sweeps + 1 + (extrapolates ? n_nodes : 0));
    const double cost = (1.0 + n_nodes * sweeps) / factor;
    if (cost < least_cost) {
      least_cost = cost;
      best = factor;
    }
    ++sweeps;
  }
  return extrapolates ? std::min(best, thresholds::longest_extrapolation) : best;
}

double smaller_size(const StepAttempt& rejected) {
  return rejected.dt * (rejected.failed ? size_after_failure : std::min(rejected.factor, most_after_rejection));
}

void set_next_size(const StepControl& control, const State& start, const StepPlan& plan, StepAttempt& accepted) {
  double next = accepted.rejected == 0 ? 2.0 * plan.dt_next : plan.dt_next;
  double found = 0.0;
  if (control.tolerance > 0.0) {
    found = accepted.dt * accepted.factor;
    const double trend = start.dt_found > 0.0 ? std::min(1.0, found / start.dt_found) : 1.0;
    // A step cut short by an event is no evidence against the size planned before.
    next = std::max(trend * found, found > accepted.dt ? plan.dt_next : 0.0);
  }
  accepted.state.dt_next = std::min(control.largest, next);
  accepted.state.dt_found = found;
}

}  // namespace vehd
