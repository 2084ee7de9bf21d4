#include "bie/stepping/time/controlled_sweeps.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/collocation.hpp"
#include "bie/stepping/time/corrections.hpp"
#include "bie/stepping/time/next_step.hpp"
#include "bie/stepping/time/step_polynomial.hpp"
#include "bie/stepping/time/sweep_errors.hpp"

namespace vehd {

namespace {

/// How many times what a step leaves of shape and V_m counts.
VisibleDifference lasting_weights(const StepGoal& goal, double dt, Beginning beginning) {
  const double remembered = std::min(1.0 + goal.memory / dt, thresholds::most_remembered);
  const double share =
      beginning == Beginning::with_past ? thresholds::remembered_share_of_past : thresholds::remembered_share;
  const double of_shape = std::max(goal.growth, share * remembered);
  return {std::min(goal.most_weight, of_shape), std::min(goal.most_weight, goal.growth)};
}

std::vector<std::size_t> coarse_at(const StepOperations& physics, const NodeSolution& end, const StepGoal& goal) {
  std::vector<std::size_t> result = goal.too_coarse(physics.end_state(end));
  for (std::size_t a = 0; a < end.vesicles.size(); ++a) {
    // The degree does not hold the same surface on another grid.
    if (end.vesicles[a].arrival_shift > goal.truncation && physics.may_rise(a)) result.push_back(a);
  }
  std::ranges::sort(result);
  result.erase(std::unique(result.begin(), result.end()), result.end());
  return result;
}

/// Error of a solution that one more correction has changed so much.
/// @param before  what the correction before has changed; zero: not known
double error_left(const VisibleDifference& change, const VisibleDifference& before = {}) {
  Corrections changes;
  if (largest_of(before) > 0.0) changes.add(largest_of(before));
  changes.add(largest_of(change));
  const double ratio = changes.count() > 1 ? changes.contraction() : 0.0;
  return changes.error_after(changes.count(), std::max(ratio, thresholds::cautious_contraction));
}

/// A solution within the step.
struct Moment {
  NodeSolution solution;
  double error = 0.0;  // estimated, of shape and V_m
};

/// What the rates at the nodes tell of a time; where that is not enough with the rate there.
/// @param contraction  of what nodes are wrong by, by a correction with their rates
Moment moment(double time, const StepPolynomial& within, const StepOperations& physics, double allowed,
              const VisibleDifference& contraction, Collocation& y) {
  const VisibleDifference stage = y.stage_error();
  const auto of_rule = [&](int n_more) {
    const VisibleDifference rule = y.rule_error(time, n_more);
    return std::max(rule.shape + contraction.shape * stage.shape,
                    rule.potential + contraction.potential * stage.potential);
  };
  const NodeSolution first = within.at(time);
  NodeSolution second = y.corrected(first, NodeEnd::remapped);
  const VisibleDifference change = physics.visible_difference(first, second);
  const double error = std::max({within.error(time), error_left(change), of_rule(0)});
  if (error <= allowed) return {std::move(second), error};
  NodeSolution third = y.corrected_with_rate(second, NodeEnd::remapped);
  const double left = error_left(physics.visible_difference(second, third), change);
  return {std::move(third), std::max(left, of_rule(1))};
}

/// A state within the step by a step of its own from the same start, where that is exact enough.
/// @param magnification  of what is wrong with shape and V_m by tension and charge
std::optional<State> by_own_step(StepOperations& physics, double time, int order, const StepGoal& goal,
                                 double magnification) {
  StepGoal own;
  // It is delivered at once, and no step goes on from it: nothing is remembered of it, and nothing grows.
  own.growth = magnification;
  own.tolerance = thresholds::moment_share / thresholds::step_share * goal.tolerance;
  own.truncation = goal.truncation;
  const ControlledSweeps sweeps = controlled_sweeps(physics, time - physics.start().time, order, own);
  return sweeps.end ? std::optional(physics.passed_state(*sweeps.end)) : std::nullopt;
}

/// Finds the states at these times.
/// @param errors  of the sweeps
/// @returns whether all are within what is allowed; if not there are none
bool pass(const std::vector<double>& times, const StepPolynomial& within, StepOperations& physics, const StepGoal& goal,
          int order, const SweepErrors& errors, Collocation& y, ControlledSweeps& result) {
  const double allowed = thresholds::moment_share * goal.tolerance;
  // Tension and charge are wrong by so much more.
  const double magnification = errors.magnification(thresholds::telling_share * allowed);
  double largest = 0.0;
  int own_steps = 0;
  for (const double time : times) {
    const Moment found = moment(time, within, physics, allowed / magnification, errors.contraction(), y);
    const double error = magnification * found.error;
    if (error <= allowed) {
      result.passed.push_back(physics.passed_state(found.solution));
      continue;
    }
    largest = std::max(largest, error);
    std::optional<State> own;
    if (++own_steps <= thresholds::most_own_steps && error <= thresholds::nearly_exact * allowed) {
      own = by_own_step(physics, time, order, goal, magnification);
    }
    if (!own) {
      result.passed.clear();
      result.excess = std::max(result.excess, largest / allowed);
      result.factor =
          std::min({result.factor, size_factor(within.error(), allowed, 4), size_factor(largest, allowed, 4)});
      return false;
    }
    result.passed.push_back(std::move(*own));
  }
  return true;
}

/// What is wanted within the step, and a size of the next one with which what is wanted within that will be exact.
/// @returns whether what is wanted is exact enough
bool look_within(StepOperations& physics, const TimeRule& rule, double dt, const StepGoal& goal, int order,
                 const SweepErrors& errors, Collocation& y, ControlledSweeps& result) {
  const double end = physics.start().time + dt;
  const std::vector<double> times = goal.times_before(end);
  if (times.empty()) return true;
  const StepPolynomial within(physics, rule, dt, y);
  if (!pass(times, within, physics, goal, order, errors, y, result)) return false;
  // It falls like dt⁴ or faster. Where the moments of the next step lie is chance.
  const bool next_has_any = goal.times_before(end + result.factor * dt).size() > times.size();
  if (next_has_any) {
    result.factor = std::min(result.factor, size_factor(within.error(), thresholds::moment_share * goal.tolerance, 4));
  }
  return true;
}

/// What became of the sweeps says what the next step is to be.
/// @param found  error after each sweep as far as it was made, as estimated then: a step ends by what it knows
NextStep next_step(const StepOperations& physics, const Collocation& y, const NodeSolution& end, const StepGoal& goal,
                   const SweepErrors& errors, const std::vector<double>& found, double allowed, int order,
                   bool accepted) {
  const double dt = end.time - physics.start().time;
  const auto counted = [&](const VisibleDifference& error, Beginning beginning) {
    return weighted(lasting_weights(goal, dt, beginning), error);
  };
  StepErrors result{allowed, found, counted(y.error_of_explicit_step(end), Beginning::afresh)};
  for (int j = static_cast<int>(std::ssize(found)) + 1; j < order; ++j) result.after.push_back(errors.error_after(j));
  if (y.beginning() == Beginning::with_past) {
    result.of_past = counted(physics.visible_difference(y.initial_node(y.last()), end), Beginning::with_past);
  } else if (physics.knows_past(dt)) {
    result.of_past = counted(physics.visible_difference(physics.continued(end.time), end), Beginning::with_past);
  }
  const int n_nodes = static_cast<int>(y.last()) + 1;
  return next_step(result, physics.start().past, dt, n_nodes, y.beginning(), accepted);
}

}  // namespace

ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal) {
  const TimeRule rule = time_rule(order);
  const bool continues = physics.start().past.is_continued == 1 && physics.knows_past(dt);
  Collocation y(physics, rule, dt, NodeEnd::remapped, continues ? Beginning::with_past : Beginning::afresh);
  const std::size_t last = y.last();
  ControlledSweeps result;
  if (!continues) result.too_coarse = coarse_at(physics, y.node(last), goal);
  if (!result.too_coarse.empty()) {
    result.state = physics.end_state(y.node(last));
    return result;
  }
  const double allowed = thresholds::step_share * goal.tolerance;
  // First-order steps leave what the first sweep contracts best, the past what it does not.
  const double least = continues ? thresholds::cautious_contraction : thresholds::best_contraction;
  SweepErrors errors(lasting_weights(goal, dt, y.beginning()), thresholds::telling_share * allowed, least);
  double of_rule = 0.0;
  std::vector<double> found;
  NextStep next;
  for (int left = order - 2;; --left) {
    y.evaluate_rates();
    if (const auto change = y.change_at_last(); change && !errors.all_known()) errors.add(*change);
    // Where this sweep is likely to be the last it ends on new nodes at once.
    const bool likely = left == 0 || (errors.sweeps() > 0 && errors.error_after(errors.sweeps() + 1) <= allowed);
    std::vector<NodeSolution> corrected = y.all_corrected(likely ? NodeEnd::remapped : NodeEnd::material);
    NodeSolution& end = corrected.back();
    // What changes the last node little by chance changes the others.
    VisibleDifference largest{};
    for (std::size_t m = 0; m <= last; ++m) {
      largest = larger_of(largest, physics.visible_difference(y.node(m), corrected[m]));
    }
    errors.add(largest);
    const bool known = errors.sweeps() >= fewest_sweeps(order);
    if (known && errors.visible_error() <= allowed && !errors.all_known() &&
        errors.error_after(errors.sweeps(), thresholds::cautious_contraction) > allowed) {
      // Tension and charge follow from what has converged, but nobody knows how they magnify what is left.
      errors.add(y.change_to(end));
    }
    of_rule = errors.lasting_or_magnified(y.rule_error(), thresholds::telling_share * allowed);
    const double of_sweeps = errors.error_after(errors.sweeps());
    const double error = std::max(of_sweeps, of_rule);
    found.push_back(of_sweeps);
    const bool enough = known && error <= allowed;
    if (enough && !likely) end = y.corrected(last, NodeEnd::remapped);
    if (enough || left == 0 || (known && errors.hoped_error_after(order - 1) > thresholds::hopeless * allowed) ||
        (known && of_rule > allowed)) {
      result.excess = error / allowed;
      next = next_step(physics, y, end, goal, errors, found, allowed, order, enough);
      result.factor = std::min(next.factor, size_factor(of_rule, allowed, 2 * static_cast<int>(rule.nodes.size())));
      result.next_beginning = next.beginning;
      if (!enough) return result;
    }
    y.replace(std::move(corrected));
    if (enough) break;
  }
  // Before what is solved for within the step can be recycled.
  result.state = physics.end_state(y.node(last));
  if (!look_within(physics, rule, dt, goal, order, errors, y, result)) return result;
  physics.remember(y.nodes(), result.state);
  result.state.past.is_continued = next.beginning == Beginning::with_past ? 1 : 0;
  result.state.past.afresh_dt = next.afresh_dt;
  result.state.past.afresh_errors = std::move(next.afresh_errors);
  result.end = std::move(y.node(last));
  return result;
}

}  // namespace vehd
