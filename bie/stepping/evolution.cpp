#include "bie/stepping/evolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/operator_checks.hpp"
#include "bie/stepping/evaluation/poration_load.hpp"
#include "bie/stepping/state/composition.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/state/symmetry.hpp"
#include "bie/stepping/time/step_control.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/side_by_side.hpp"

namespace vehd {

namespace {

/// Attempts after which a step no longer starts from the extrapolation: it can be what fails, as across a jump.
constexpr int most_tries_from_past = 2;
/// Nodes of the singular quadrature at each level, relative to those of the settings. From level to level the error
/// falls by at least two digits.
constexpr std::array quadrature_levels = {1.0, 1.75, 2.6};

constexpr std::int64_t highest_level = quadrature_levels.size() - 1;

ResolutionLevel level_of(int order, std::int64_t quadrature_level) {
  return {order, quadrature_levels.at(static_cast<std::size_t>(quadrature_level))};
}

/// Discretisation with the degrees and quadrature levels of a state.
Discretisation discretisation_of(const EvolutionSetup& setup, const State& state) {
  std::vector<ResolutionLevel> levels;
  for (const VesicleState& vesicle : state.vesicles) {
    levels.push_back(level_of(order_of(vesicle.position.rows()), vesicle.quadrature_level));
  }
  return {setup.settings, setup.symmetry, levels, setup.ranks};
}

/// Spacing of the coarsest grid, over the radius.
double grid_spacing(const State& state) {
  int lowest = order_of(state.vesicles.front().position.rows());
  for (const VesicleState& vesicle : state.vesicles) lowest = std::min(lowest, order_of(vesicle.position.rows()));
  return std::numbers::pi / (lowest + 1);
}

}  // namespace

Evolution::Evolution(EvolutionSetup setup, const std::vector<StartMembrane>& start, Instruments& instruments)
    : setup_(std::move(setup)),
      instruments_(instruments),
      discretisation_(setup_.settings, setup_.symmetry, {}),
      start_(start) {
  std::vector<int> orders = with_images(setup_.symmetry.exchange, starting_orders(start));
  for (bool resolved = false; !resolved;) {
    start_at(orders, start);
    // The area, which is the scale, and V_m are available only now.
    resolved = true;
    const SmallestGap gap = smallest_gap(state_);
    for (std::size_t a = 0; a < orders.size(); ++a) {
      const Resolution found = resolution(state_, a);
      const int of_gap = order_of_gap(gap, a);
      if (resolves(found, a) && orders[a] >= of_gap) continue;
      orders[a] = std::max(resolves(found, a) ? orders[a] : raised_order(found, a), of_gap);
      resolved = false;
    }
    orders = with_images(setup_.symmetry.exchange, std::move(orders));
  }
}

Evolution::Evolution(EvolutionSetup setup, State state, Instruments& instruments)
    : setup_(std::move(setup)),
      instruments_(instruments),
      discretisation_(discretisation_of(setup_, with_images(setup_.symmetry.exchange, state))),
      state_(with_images(setup_.symmetry.exchange, std::move(state))) {}

/// Growth of wrinkles under the present tension and after the next discontinuity of the forcing before `end`: an
/// elongated membrane can be compressed then, and raising the degree later cannot restore what was truncated.
void Evolution::expect_growth(double end) {
  if (!adapts() || !setup_.model.mobile) return;
  growth_ = growth_of_wrinkles(setup_.model, state_, evaluation_);
  const std::optional<double> jump = next_discontinuity(setup_.model, state_.time);
  if (!jump || *jump >= end) return;
  State there = state_;
  there.time = *jump;
  try {
    const SolvedFields after = solve_fields(setup_.model, discretisation_, there, instruments_, &evaluation_,
                                            Limit::after, Shapes::of_previous);
    growth_ = std::max(growth_, growth_of_wrinkles(setup_.model, there, after));
  } catch (const ConvergenceError&) {
    // Without a solution there the present growth is used.
  }
}

double Evolution::truncation(const State& state) const {
  double most = 0.0;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) most = std::max(most, resolution(state, a).remainder());
  return most;
}

Resolution Evolution::resolution(const State& state, std::size_t a) const {
  const VesicleState& vesicle = state.vesicles[a];
  VisibleShare share;
  if (adapts()) {
    const int order = order_of(vesicle.position.rows());
    // A state of a former degree is only looked at.
    const Discretisation space =
        order == this->order(a) ? discretisation_ : discretisation_.with(a, level_of(order, 0));
    share = visible_share(space.vesicle(a).fine_transform(), vesicle);
  }
  if (!is_averaged(setup_.model) || evaluation_.vesicles.empty()) return {setup_.model, vesicle, share};
  // V_m of the last shape for which the fields were solved.
  const Matrix& potential = evaluation_.fields.vesicles[a].potential_amplitude;
  return {setup_.model, vesicle, resize_order(potential, order_of(vesicle.position.rows())), share};
}

void Evolution::start_at(const std::vector<int>& orders, const std::vector<StartMembrane>& start) {
  std::vector<StartMembrane> membranes = start;
  std::vector<ResolutionLevel> levels;
  for (std::size_t a = 0; a < orders.size(); ++a) {
    membranes[a].position = resize_order(membranes[a].position, orders[a]);
    levels.push_back(level_of(orders[a], 0));
  }
  discretisation_ = Discretisation(setup_.settings, setup_.symmetry, levels, setup_.ranks);
  state_ =
      initial_state(setup_.model, discretisation_, membranes, adapts() ? 0.0 : setup_.control.largest, instruments_);
}

/// Changes the space of a vesicle and its images. @throws ConvergenceError; everything is then unchanged
void Evolution::change_space(std::size_t a, int order, std::int64_t quadrature_level) {
  Discretisation discretisation = discretisation_;
  State state = state_;
  for (std::size_t b = 0; b < state.vesicles.size(); ++b) {
    if (setup_.symmetry.exchange.original(b) != a) continue;
    discretisation = discretisation.with(b, level_of(order, quadrature_level));
    state.vesicles[b] = resized(std::move(state.vesicles[b]), order);
    state.vesicles[b].quadrature_level = quadrature_level;
  }
  Evaluation evaluation = evaluate(setup_.model, discretisation, state, instruments_);
  // A coarser space that is not accurate enough would have to be refined at the next step.
  const bool coarsens = order < this->order(a) || quadrature_level < state_.vesicles[a].quadrature_level;
  if (coarsens && evaluation.diagnostics.vesicles[a].quadrature_is_coarse) return;
  discretisation_ = std::move(discretisation);
  replace(std::move(state), std::move(evaluation));
}

void Evolution::replace(State state, Evaluation evaluation) {
  if (keep_former_) keep_former_(std::move(state_), std::move(evaluation_));
  state_ = std::move(state);
  evaluation_ = std::move(evaluation);
}

namespace {

/// Refines the quadrature where it is too coarse. @returns false if nothing was refined
bool refine_quadrature(State& state, Discretisation& discretisation, const Evaluation& evaluation) {
  bool refined = false;
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    VesicleState& vesicle = state.vesicles[a];
    if (!evaluation.diagnostics.vesicles[a].quadrature_is_coarse || vesicle.quadrature_level >= highest_level) continue;
    ++vesicle.quadrature_level;
    discretisation = discretisation.with(a, level_of(discretisation.vesicle(a).order(), vesicle.quadrature_level));
    refined = true;
  }
  return refined;
}

}  // namespace

/// Makes this the state, with a sufficient quadrature. @throws ConvergenceError; the former state is then kept
void Evolution::arrive(State state) {
  const bool has_moved = setup_.model.mobile || evaluation_.vesicles.empty();
  const SmallestGap gap = has_moved ? smallest_gap(state) : gap_;
  require_gap(gap, gap_, grid_spacing(state), setup_.frame, setup_.names);
  Discretisation discretisation = discretisation_;
  const auto evaluated = [&](const Evaluation* previous, Limit limit) {
    return evaluate(setup_.model, discretisation, state, instruments_, previous, limit);
  };
  const bool has_former = !evaluation_.vesicles.empty();
  Evaluation evaluation = evaluated(has_former ? &evaluation_ : nullptr, Limit::after);
  while (refine_quadrature(state, discretisation, evaluation)) evaluation = evaluated(nullptr, Limit::after);
  for (std::size_t a = 0; a < state.vesicles.size(); ++a) {
    const double separation = evaluation.diagnostics.vesicles[a].separation;
    require_apart(separation, has_former ? evaluation_.diagnostics.vesicles[a].separation : separation);
  }
  std::optional<Evaluation> before;
  if (has_former && jumps_at(setup_.model, state.time)) {
    before = without_operators(evaluated(&evaluation, Limit::before));
  }
  note_first_crossings(has_former ? &evaluation_ : nullptr, state_.time, before ? *before : evaluation, evaluation,
                       state);
  report_crossings(state, state.time, evaluation);
  if (before) report_crossings(state, state.time, *before);
  discretisation_ = std::move(discretisation);
  // The extrapolation is not valid across a jump.
  if (before) state = without_past(std::move(state));
  replace(std::move(state), std::move(evaluation));
  gap_ = gap;
  before_jump_ = std::move(before);
}

std::vector<Evolution::DenseOutput> Evolution::evaluate_dense_output(const std::vector<State>& states,
                                                                     StepAttempt& attempt) {
  std::vector<DenseOutput> output(states.size());
  attempt.evaluations += static_cast<int>(states.size());
  for_each_side_by_side(
      std::ssize(states), discretisation_.leaves_threads_idle(), instruments_, [&](Index i, Instruments& instruments) {
        const State& state = states[static_cast<std::size_t>(i)];
        DenseOutput& at = output[static_cast<std::size_t>(i)];
        Evaluation evaluation = evaluate(setup_.model, discretisation_, state, instruments, &evaluation_);
        at = {state, without_operators(std::move(evaluation)), smallest_gap(state)};
        for (VesicleState& vesicle : at.state.vesicles) vesicle.recycled = {};
      });
  return output;
}

StepPlan Evolution::plan_towards(const EventTimes& events, double dt_next) const {
  EventTimes ends = events;
  // With a tolerance snapshots are taken from within the steps.
  if (adapts()) ends.snapshots = {};
  const std::optional<double> discontinuity = next_discontinuity(setup_.model, state_.time);
  if (discontinuity) ends.discontinuity = std::min(*discontinuity, events.discontinuity.value_or(*discontinuity));
  return plan_step(state_.time, std::min(dt_next, setup_.control.largest), ends);
}

double Evolution::reach(const EventTimes& events) const {
  const StepPlan plan = plan_towards(events, state_.dt_next);
  return plan.reaches_event ? plan.event_time : state_.time + plan.dt;
}

/// @param former  earlier attempts at the same step, whose work is added to that of this one
/// @throws ConvergenceError if the step has become too small
StepAttempt Evolution::attempted(const StepPlan& plan, const SnapshotTimes& snapshots,
                                 const StepAttempt& former) const {
  const StepControl& control = setup_.control;
  if (!(plan.dt_next >= control.smallest)) {
    const std::string rounding =
        fmt::format("one of {} is needed, but all below {} are lost in the rounding of end_time",
                    setup_.time_text(plan.dt_next), setup_.time_text(control.smallest));
    throw ConvergenceError(fmt::format("no acceptable step from time {}: {}", setup_.time_text(state_.time),
                                       former.reason.empty() ? rounding : former.reason));
  }
  const StepGoal goal{control.tolerance, snapshots};
  StepAttempt attempt = attempt_step({setup_.model, discretisation_, state_, evaluation_}, plan.dt, instruments_,
                                     adapts() ? &goal : nullptr);
  attempt.add_work_of(former);
  return attempt;
}

/// Accepts or rejects an attempt; the end of an accepted one becomes the state.
/// @param raised  vesicles whose degree has risen for this step
Evolution::Reaction Evolution::react(StepAttempt& attempt, const StepPlan& plan, std::vector<bool>& raised) {
  if (!attempt.accepted) return Reaction::repeat_smaller;
  try {
    if (raise_orders_for(attempt, raised)) return Reaction::repeat_in_higher_degree;
    if (plan.reaches_event) attempt.state.time = plan.event_time;
    set_next_size(setup_.control, state_, plan, attempt);
    std::vector<DenseOutput> output = evaluate_dense_output(attempt.dense_states, attempt);
    arrive(attempt.state);
    for (DenseOutput& at : output) report_crossings(state_, at.state.time, at.evaluation);
    dense_output_ = std::move(output);
    return Reaction::accept;
  } catch (const ConvergenceError& error) {
    // With a smaller step the solves may converge.
    attempt.reject(error.what());
    return Reaction::repeat_smaller;
  }
}

StepAttempt Evolution::step(const EventTimes& events) {
  expect_growth(events.end_time);
  const double from = state_.time;
  std::vector<bool> raised(state_.vesicles.size(), false);
  StepPlan plan = plan_towards(events, state_.dt_next);
  StepAttempt attempt;
  for (;;) {
    attempt = attempted(plan, events.snapshots, attempt);
    const Reaction reaction = react(attempt, plan, raised);
    if (reaction == Reaction::accept) break;
    ++attempt.rejected;
    // The extrapolation may be the reason for repeated failures.
    if (attempt.rejected == most_tries_from_past) state_ = without_past(std::move(state_));
    if (reaction == Reaction::repeat_smaller) plan = plan_towards(events, smaller_size(attempt));
  }
  const Evaluation& arrival = before_jump_ ? *before_jump_ : evaluation_;
  ++attempt.evaluations;
  attempt.iterations_flow += arrival.iterations_flow;
  attempt.iterations_electric += arrival.iterations_electric;
  attempt.at_snapshot = (plan.reaches_event && plan.is_snapshot) ||
                        (adapts() && events.snapshots.is_due(state_.time, from, events.end_time));
  // Just after a jump of the forcing the spectrum has not responded yet.
  if (!before_jump_) coarsen();
  return attempt;
}

}  // namespace vehd
