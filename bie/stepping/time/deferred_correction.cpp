#include "bie/stepping/time/deferred_correction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/past.hpp"
#include "bie/stepping/time/step_control.hpp"

namespace vehd {

int evaluations_per_step(int order) { return 1 + (order - 1) * static_cast<int>(time_rule(order).nodes.size()); }

CorrectedNode deferred_correction(StepOperations& physics, double dt, int order) {
  if (order == 1) return {physics.first_order_steps({{dt, NodeEnd::remapped}}).front()};
  const TimeRule rule = time_rule(order);
  Collocation y(physics, rule, dt, NodeEnd::material);
  CorrectedNode result;
  for (int sweep = 1; sweep < order; ++sweep) {
    y.evaluate_rates();
    if (sweep < order - 1) {
      y.replace(y.all_corrected(NodeEnd::material));
      continue;
    }
    // Nodes are independent within a sweep, and only the last one is needed now.
    NodeSolution corrected = y.corrected(y.last(), NodeEnd::remapped);
    result.last_correction = difference(physics.start(), y.node(y.last()), corrected);
    y.node(y.last()) = std::move(corrected);
  }
  result.node = std::move(y.node(y.last()));
  return result;
}

double Corrections::error_after(std::size_t j, double ratio) const {
  const std::size_t n = changes_.size();
  if (n == 0) return 0.0;
  if (j < n) return changes_[j];
  return changes_.back() * std::pow(ratio, static_cast<double>(j - n)) * (ratio < 0.5 ? ratio / (1.0 - ratio) : 1.0);
}

double Corrections::contraction() const {
  const std::size_t n = changes_.size();
  if (n < 2 || changes_[n - 2] <= 0.0) return 1.0;
  return std::clamp(changes_[n - 1] / changes_[n - 2], thresholds::best_contraction, 1.0);
}

namespace {

/// Fewest sweeps of a step: after one the contraction is unknown.
int fewest_sweeps(int order) { return std::min(2, order - 1); }

double largest_of(const VisibleDifference& error) { return std::max(error.shape, error.potential); }

/// Corrections of all sweeps so far.
struct SweepErrors {
  Corrections visible;  // shape and V_m
  Corrections derived;  // tension and charge, known one sweep later

  /// Relative error of tension and charge over that of shape and V_m, from the last sweep for which both are known.
  [[nodiscard]] double magnification() const {
    const std::size_t k = derived.count();
    return k > 0 && visible.change(k) > 0.0 ? std::max(1.0, derived.change(k) / visible.change(k)) : 1.0;
  }
  /// Estimated error after sweep j, past or still to come.
  [[nodiscard]] double after(int sweep) const {
    return magnification() * visible.error_after(static_cast<std::size_t>(sweep));
  }
  /// Estimated error over the allowed one, for each number of sweeps that a step of this order can have.
  [[nodiscard]] std::vector<double> excess(double allowed, int order) const {
    std::vector<double> result;
    for (int j = fewest_sweeps(order); j < order; ++j) result.push_back(after(j) / allowed);
    return result;
  }
};

double largest_change(const StepStart& start, const Collocation& y, const std::vector<NodeSolution>& corrected) {
  // The correction of one node may pass through zero by chance.
  double largest = 0.0;
  for (std::size_t m = 0; m < corrected.size(); ++m) {
    largest = std::max(largest, largest_of(visible_difference(start, y.node(m), corrected[m])));
  }
  return largest;
}

/// A solution within the step with its estimated error.
struct InterpolatedSolution {
  NodeSolution solution;
  double error = 0.0;
};

/// A step after its sweeps.
struct SweptStep {
  const StepStart& start;
  const TimeRule& rule;
  double dt;
  const Collocation& y;
  const SweepErrors& errors;
  const std::vector<VisibleDifference>& derivatives;  // of the rates

  /// The solution at a time within the step, corrected with the rates at the nodes and, if its error is too large, once
  /// more with the rate there.
  [[nodiscard]] InterpolatedSolution at(double time, double allowed) const {
    std::vector<double> points = points_of(rule);
    const double place = (time - start.state.time) / dt;
    Corrections changes;
    const NodeSolution first = y.within(time);
    NodeSolution second = y.corrected(first, NodeEnd::remapped);
    changes.add(largest_of(visible_difference(start, first, second)));
    // This correction is assumed to contract like the sweeps.
    const double error =
        std::max(changes.error_after(1, errors.visible.contraction()), rule_error(points, place, derivatives));
    if (error <= allowed) return {std::move(second), error};
    NodeSolution third = y.corrected_with_rate(second, NodeEnd::remapped);
    changes.add(largest_of(visible_difference(start, second, third)));
    points.push_back(place);
    return {std::move(third), std::max(changes.error_after(2), rule_error(points, place, derivatives))};
  }
};

/// Finds the states at the output times of the goal. @returns whether all are accurate enough
bool find_dense_states(const SweptStep& step, const StepGoal& goal, ControlledSweeps& result) {
  const double start = step.start.state.time;
  const double allowed = thresholds::dense_output_share * goal.tolerance / step.errors.magnification();
  for (const double time : goal.output_times.between(start, start + step.dt)) {
    const InterpolatedSolution found = step.at(time, allowed);
    if (found.error > allowed) {
      const int power = static_cast<int>(step.rule.nodes.size()) + 2;
      result.excess = found.error / allowed;
      result.factor = std::min(result.factor, size_factor(result.excess, power));
      return false;
    }
    result.dense_states.push_back(state_at(step.start, found.solution));
  }
  return true;
}

}  // namespace

ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal) {
  const TimeRule rule = time_rule(order);
  const int n_nodes = static_cast<int>(rule.nodes.size());
  const Predictor predictor = can_extrapolate(physics.start().state, dt) ? Predictor::extrapolation : Predictor::euler;
  Collocation y(physics, rule, dt, NodeEnd::remapped, predictor);
  const double allowed = thresholds::step_share * goal.tolerance;
  ControlledSweeps result;
  SweepErrors errors;
  std::vector<VisibleDifference> derivatives;
  for (int sweep = 1;; ++sweep) {
    y.evaluate_rates();
    if (const auto change = y.change_at_last()) errors.derived.add(change->largest());
    // If this sweep is likely to be the last, its end is remapped at once.
    const bool likely = sweep == order - 1 || (sweep > 1 && errors.after(sweep) <= allowed);
    std::vector<NodeSolution> corrected = y.all_corrected(likely ? NodeEnd::remapped : NodeEnd::material);
    errors.visible.add(largest_change(physics.start(), y, corrected));
    const double of_sweeps = errors.after(sweep);
    const bool enough = sweep >= fewest_sweeps(order) && of_sweeps <= allowed;
    if (enough || sweep == order - 1) {
      if (enough) derivatives = y.derivatives();
      const double of_rule = enough ? rule_error(rule, derivatives) : 0.0;
      result.excess = std::max(of_sweeps, of_rule) / allowed;
      result.factor = std::min(cheapest_factor(errors.excess(allowed, order), fewest_sweeps(order), n_nodes,
                                               predictor == Predictor::extrapolation),
                               size_factor(of_rule / allowed, 2 * n_nodes));
      if (result.excess > 1.0) return result;
      if (!likely) corrected.back() = y.corrected(y.last(), NodeEnd::remapped);
      y.replace(std::move(corrected));
      break;
    }
    y.replace(std::move(corrected));
  }
  // Solves for states within the step must not change the subspaces that the next step recycles.
  result.state = physics.end_state(y.node(y.last()));
  if (!find_dense_states({physics.start(), rule, dt, y, errors, derivatives}, goal, result)) return result;
  // Otherwise extrapolations would amplify stiff errors from step to step.
  if (errors.visible.converge()) store_past(physics.start(), y.nodes(), result.state);
  result.end = std::move(y.node(y.last()));
  return result;
}

}  // namespace vehd
