#include "bie/stepping/evolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/resolution.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Share of the tolerance that the degrees left out may make up.
constexpr double kTruncationShare = 0.3;
constexpr int kLowestOrder = 8;

std::unique_ptr<Discretisation> discretisation_of(const EvolutionSetup& setup, int order) {
  NumericalSettings settings = setup.settings;
  settings.order = order;
  return std::make_unique<Discretisation>(settings, setup.symmetry);
}

int lowest_order(const EvolutionSetup& setup) { return std::min(kLowestOrder, setup.settings.order); }

int starting_order(const EvolutionSetup& setup, const Matrix& position) {
  if (setup.control.tolerance == 0.0) return setup.settings.order;
  State shape;
  shape.position = position;
  // Exact for a sphere, and only a scale.
  shape.reference_area = position.bottomRows(position.rows() - 1).squaredNorm();
  return Resolution(setup.model, shape)
      .order_for(kTruncationShare * setup.control.tolerance, lowest_order(setup), setup.settings.order);
}

/// A first step small against the time in which the start changes.
double first_step(const EvolutionSetup& setup, const Evaluation& evaluation, const State& state) {
  constexpr double kShare = 0.5;
  const double radius = std::sqrt(state.reference_area / (4.0 * std::numbers::pi));
  double rate = 0.0;
  if (evaluation.fields.velocity.size() > 0) rate = evaluation.fields.velocity.norm() / radius;
  if (evaluation.potential_rate.size() > 0) {
    const double scale = potential_scale(*setup.model.electric, radius, state.transmembrane_potential.norm());
    rate = std::max(rate, evaluation.potential_rate.norm() / scale);
  }
  const double share = kShare * std::pow(setup.control.tolerance, 1.0 / setup.settings.time_order);
  return rate > 0.0 ? std::min(share / rate, setup.control.largest) : setup.control.largest;
}

}  // namespace

Evolution::Evolution(EvolutionSetup setup, const Matrix& position, bool steady_potential, Instruments& instruments)
    : setup_(std::move(setup)),
      instruments_(instruments),
      discretisation_(discretisation_of(setup_, starting_order(setup_, position))),
      state_(initial_state(setup_.model, *discretisation_, resize_order(position, discretisation_->order()),
                           steady_potential, adapts() ? 0.0 : setup_.control.largest, instruments)) {}

Evolution::Evolution(EvolutionSetup setup, State state, Instruments& instruments)
    : setup_(std::move(setup)),
      instruments_(instruments),
      discretisation_(discretisation_of(setup_, order_of(state.position.rows()))),
      state_(std::move(state)) {}

Evolution::~Evolution() = default;

void Evolution::evaluate_start() {
  evaluation_ = evaluate(setup_.model, *discretisation_, state_, instruments_);
  if (state_.dt_next == 0.0) state_.dt_next = first_step(setup_, evaluation_, state_);
}

double Evolution::truncation() const { return Resolution(setup_.model, state_).remainder(); }

void Evolution::change_order(int order) {
  discretisation_ = discretisation_of(setup_, order);
  state_ = resized(std::move(state_), order);
  evaluation_ = evaluate(setup_.model, *discretisation_, state_, instruments_);
}

bool Evolution::raise_order_for(const State& reached) {
  if (!adapts() || order() >= setup_.settings.order) return false;
  const Resolution resolution(setup_.model, reached);
  const double target = kTruncationShare * setup_.control.tolerance;
  if (resolution.remainder() <= target) return false;
  change_order(
      std::min(setup_.settings.order, std::max(resolution.order_for(target, order(), order() + 8), order() + 2)));
  return true;
}

void Evolution::lower_order_if_idle() {
  // Far enough below the target that the degree does not rise again at once.
  constexpr double kIdle = 0.1;
  constexpr int kWorthwhile = 4;
  if (!adapts() || order() <= lowest_order(setup_)) return;
  const int enough = Resolution(setup_.model, state_)
                         .order_for(kIdle * kTruncationShare * setup_.control.tolerance, lowest_order(setup_), order());
  if (enough <= order() - kWorthwhile) change_order(enough);
}

Advance Evolution::advance_within(const StepPlan& plan, EvolutionStep& record) {
  State from = state_;
  // Equal up to rounding: the step must end on the event, not just before it.
  if (plan.reaches_event) from.dt_next = std::max(from.dt_next, plan.dt_limit);
  Advance advanced =
      advance(setup_.model, *discretisation_, from, evaluation_, setup_.control, plan.dt_limit, instruments_);
  record.rejected += advanced.rejected;
  record.iterations_flow += advanced.iterations_flow;
  record.iterations_electric += advanced.iterations_electric;
  if (!advanced.accepted) {
    throw ConvergenceError(fmt::format("no acceptable step from time {:g}: {}", state_.time, advanced.reason));
  }
  return advanced;
}

EvolutionStep Evolution::step(const EventTimes& events) {
  EventTimes all = events;
  const std::optional<double> corner = next_corner(setup_.model, state_.time);
  if (corner) all.corner = std::min(*corner, events.corner.value_or(*corner));
  StepPlan plan = plan_step(state_.time, state_.dt_next, all);
  EvolutionStep record;
  for (;;) {
    Advance advanced = advance_within(plan, record);
    if (raise_order_for(advanced.state)) {
      ++record.rejected;
      continue;
    }
    try {
      Evaluation evaluation = evaluate(setup_.model, *discretisation_, advanced.state, instruments_, &evaluation_);
      record.dt = advanced.dt;
      record.change = advanced.change;
      record.iterations_flow += evaluation.iterations_flow;
      record.iterations_electric += evaluation.iterations_electric;
      const bool at_event = plan.reaches_event && advanced.dt == plan.dt_limit;
      if (at_event) advanced.state.time = plan.event_time;
      record.at_snapshot = at_event && plan.is_snapshot;
      state_ = std::move(advanced.state);
      evaluation_ = std::move(evaluation);
    } catch (const ConvergenceError&) {
      // The new state cannot be solved for, so the step that led there is rejected as well.
      ++record.rejected;
      plan.dt_limit = advanced.dt / 2.0;
      plan.reaches_event = false;
      if (plan.dt_limit < setup_.control.smallest) throw;
      continue;
    }
    lower_order_if_idle();
    return record;
  }
}

}  // namespace vehd
