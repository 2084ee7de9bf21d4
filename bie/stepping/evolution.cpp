#include "bie/stepping/evolution.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// Nodes of the singular quadrature at each level, relative to those of the settings. Between two levels its error
/// falls by two digits and more.
constexpr std::array kQuadratureLevels = {1.0, 1.75, 2.6};
constexpr std::int64_t kHighestLevel = kQuadratureLevels.size() - 1;

/// Distance of two parts of the membrane, in grid spacings, at which D has lost all but two digits on the finest level.
constexpr double kContact = 0.1;
/// Two parts may come nearer by this factor in one step once they are closer than the grid spacing: with larger steps
/// they could pass through each other unseen.
constexpr double kLeastApproach = 0.5;

/// Steps between two attempts to save work: one that fails every time costs little of what a run does.
constexpr std::int64_t kEconomyInterval = 4;

std::unique_ptr<Discretisation> discretisation_of(const EvolutionSetup& setup, int order, std::int64_t level) {
  NumericalSettings settings = setup.settings;
  settings.order = order;
  settings.quadrature_oversampling *= kQuadratureLevels.at(static_cast<std::size_t>(level));
  return std::make_unique<Discretisation>(settings, setup.symmetry);
}

void require_apart(double separation, double before) {
  if (separation < kContact) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane are {:.2g} grid spacings from each other, too near for any quadrature", separation));
  }
  if (separation < std::min(1.0, kLeastApproach * before)) {
    throw ConvergenceError(fmt::format(
        "two parts of the membrane come within {:.2g} grid spacings of each other in one step", separation));
  }
}

int lowest_order(const EvolutionSetup& setup) { return std::min(lowest_adaptive_order, setup.settings.order); }

double truncation_target(const EvolutionSetup& setup) { return truncation_share * setup.control.tolerance; }

int starting_order(const EvolutionSetup& setup, const Matrix& position, const Vector& potential) {
  if (setup.control.tolerance == 0.0) return setup.settings.order;
  State shape;
  shape.position = position;
  if (potential.size() > 0) shape.transmembrane_potential = resize_order(potential, order_of(position.rows()));
  // Exact for a sphere, and only a scale.
  shape.reference_area = position.bottomRows(position.rows() - 1).squaredNorm();
  return Resolution(setup.model, shape).order_for(truncation_target(setup), lowest_order(setup), setup.settings.order);
}

/// A first step small against the time in which the start changes.
double first_step(const EvolutionSetup& setup, const Evaluation& evaluation, const State& state) {
  constexpr double kShare = 0.5;
  const double radius = std::sqrt(state.reference_area / (4.0 * std::numbers::pi));
  double rate = 0.0;
  // Degree 0 carries the membrane along and changes nothing of it.
  const Matrix& velocity = evaluation.fields.velocity;
  if (velocity.size() > 0) rate = velocity.bottomRows(velocity.rows() - 1).norm() / radius;
  if (evaluation.potential_rate.size() > 0) {
    const double scale = potential_scale(*setup.model.electric, radius, state.transmembrane_potential.norm());
    rate = std::max(rate, evaluation.potential_rate.norm() / scale);
  }
  const double share = kShare * std::pow(setup.control.tolerance, 1.0 / setup.settings.time_order);
  return rate > 0.0 ? std::min(share / rate, setup.control.largest) : setup.control.largest;
}

}  // namespace

Evolution::Evolution(EvolutionSetup setup, const Matrix& position, const StartPotential& potential,
                     Instruments& instruments)
    : setup_(std::move(setup)), instruments_(instruments) {
  start_at(starting_order(setup_, position, potential.given), position, potential);
  // The area, which is the scale, and V_m are known only now.
  for (Resolution start(setup_.model, state_); !resolves(start); start = Resolution(setup_.model, state_)) {
    start_at(raised_order(start), position, potential);
  }
}

Evolution::Evolution(EvolutionSetup setup, State state, Instruments& instruments)
    : setup_(std::move(setup)),
      instruments_(instruments),
      discretisation_(discretisation_of(setup_, order_of(state.position.rows()), state.quadrature_level)),
      state_(std::move(state)) {}

Evolution::~Evolution() = default;

void Evolution::evaluate_start() {
  arrive(state_);
  if (state_.dt_next == 0.0) state_.dt_next = first_step(setup_, evaluation_, state_);
}

double Evolution::truncation() const { return Resolution(setup_.model, state_).remainder(); }

void Evolution::start_at(int order, const Matrix& position, const StartPotential& potential) {
  discretisation_ = discretisation_of(setup_, order, 0);
  state_ = initial_state(setup_.model, *discretisation_, resize_order(position, order), potential,
                         adapts() ? 0.0 : setup_.control.largest, instruments_);
}

/// @throws ConvergenceError, and everything stays
void Evolution::change_discretisation(int order, std::int64_t quadrature_level) {
  std::unique_ptr<Discretisation> discretisation = discretisation_of(setup_, order, quadrature_level);
  State state = resized(state_, order);
  state.quadrature_level = quadrature_level;
  Evaluation evaluation = evaluate(setup_.model, *discretisation, state, instruments_);
  // Less work that is not exact enough would have to be undone at the next step.
  const bool is_economy = order < this->order() || quadrature_level < state_.quadrature_level;
  if (is_economy && evaluation.quadrature_is_coarse) return;
  evaluation_ = std::move(evaluation);
  discretisation_ = std::move(discretisation);
  state_ = std::move(state);
}

/// Makes this the state, with a quadrature that resolves it. @throws ConvergenceError, and the former state stays
void Evolution::arrive(State state) {
  std::unique_ptr<Discretisation> finer;
  const auto evaluated = [&](const Evaluation* previous, Limit limit) {
    return evaluate(setup_.model, finer ? *finer : *discretisation_, state, instruments_, previous, limit);
  };
  const bool has_former = evaluation_.parts != nullptr;
  Evaluation evaluation = evaluated(has_former ? &evaluation_ : nullptr, Limit::after);
  while (evaluation.quadrature_is_coarse && state.quadrature_level < kHighestLevel) {
    ++state.quadrature_level;
    finer = discretisation_of(setup_, order(), state.quadrature_level);
    evaluation = evaluated(nullptr, Limit::after);
  }
  const double separation = evaluation.diagnostics.separation;
  require_apart(separation, has_former ? evaluation_.diagnostics.separation : separation);
  std::optional<Evaluation> before;
  if (has_former && jumps_at(setup_.model, state.time)) {
    before = evaluated(&evaluation, Limit::before);
    before->parts.reset();
  }
  evaluation_ = std::move(evaluation);
  if (finer) discretisation_ = std::move(finer);
  state_ = std::move(state);
  before_jump_ = std::move(before);
}

void Evolution::lower_quadrature_if_idle() {
  constexpr double kIdle = 1e-2;
  if (state_.quadrature_level == 0) return;
  if (evaluation_.diagnostics.quadrature_error > kIdle * setup_.settings.quadrature_tolerance) return;
  change_discretisation(order(), state_.quadrature_level - 1);
}

/// Does the degree leave out little enough, or is there no higher one?
bool Evolution::resolves(const Resolution& resolution) const {
  return !adapts() || order() >= setup_.settings.order || resolution.remainder() <= truncation_target(setup_);
}

int Evolution::raised_order(const Resolution& resolution) const {
  const int enough = resolution.order_for(truncation_target(setup_), order(), order() + 8);
  return std::min(setup_.settings.order, std::max(enough, order() + 2));
}

/// @throws ConvergenceError, and everything stays
bool Evolution::raise_order_for(const State& reached) {
  const Resolution resolution(setup_.model, reached);
  if (resolves(resolution)) return false;
  const int raised = raised_order(resolution);
  try {
    change_discretisation(raised, state_.quadrature_level);
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(fmt::format(
        "no acceptable step from time {:g}: degree {} leaves out {:.1e}, accepted: {:.1e}, and degree {} fails: {}",
        state_.time, order(), resolution.remainder(), truncation_target(setup_), raised, error.what()));
  }
  return true;
}

void Evolution::lower_order_if_idle() {
  // Far enough below the target that the degree does not rise again at once.
  constexpr double kIdle = 0.1;
  constexpr int kWorthwhile = 4;
  if (!adapts() || order() <= lowest_order(setup_)) return;
  const int enough =
      Resolution(setup_.model, state_).order_for(kIdle * truncation_target(setup_), lowest_order(setup_), order());
  if (enough <= order() - kWorthwhile) change_discretisation(enough, state_.quadrature_level);
}

void Evolution::economise() {
  if (state_.step % kEconomyInterval != 0) return;
  for (const auto economy : {&Evolution::lower_order_if_idle, &Evolution::lower_quadrature_if_idle}) {
    try {
      (this->*economy)();
    } catch (const ConvergenceError&) {
      // What cannot be had for less goes on as it is.
    }
  }
}

Advance Evolution::advance_within(const StepPlan& plan, double wanted, EvolutionStep& record) {
  State from = state_;
  // Equal up to rounding: the step must end on the event, not just before it.
  from.dt_next = plan.reaches_event ? std::max(wanted, plan.dt_limit) : wanted;
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
  double wanted = state_.dt_next;
  EvolutionStep record;
  for (;;) {
    Advance advanced = advance_within(plan, wanted, record);
    const bool at_event = plan.reaches_event && advanced.dt == plan.dt_limit;
    try {
      if (raise_order_for(advanced.state)) {
        ++record.rejected;
        continue;
      }
      State reached = advanced.state;
      if (at_event) reached.time = plan.event_time;
      arrive(std::move(reached));
    } catch (const ConvergenceError&) {
      // What cannot be solved for after this step may be after a smaller one.
      ++record.rejected;
      wanted = plan.dt_limit = advanced.dt / 2.0;
      plan.reaches_event = false;
      if (plan.dt_limit < setup_.control.smallest) throw;
      continue;
    }
    const Evaluation& arrival = before_jump_ ? *before_jump_ : evaluation_;
    record.dt = advanced.dt;
    record.change = advanced.change;
    record.raw_area = advanced.raw_area;
    record.iterations_flow += arrival.iterations_flow;
    record.iterations_electric += arrival.iterations_electric;
    record.at_snapshot = at_event && plan.is_snapshot;
    // Nothing is idle where the forcing has just changed.
    if (!before_jump_) economise();
    return record;
  }
}

}  // namespace vehd
