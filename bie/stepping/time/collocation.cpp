#include "bie/stepping/time/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "bie/stepping/thresholds.hpp"

namespace vehd {

VisibleDifference larger_of(const VisibleDifference& a, const VisibleDifference& b) {
  return {std::max(a.shape, b.shape), std::max(a.potential, b.potential)};
}

Collocation::Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end, Beginning beginning)
    : physics_(physics), rule_(rule), dt_(dt), beginning_(beginning) {
  if (beginning == Beginning::with_past) {
    for (const double node : rule.nodes) nodes_.push_back(initial(physics.start().time + node * dt));
    initial_nodes_ = nodes_;
    return;
  }
  std::vector<FirstOrderStep> steps;
  for (const double node : rule.nodes) steps.push_back({node * dt, NodeEnd::material});
  steps.back().end = end;
  nodes_ = physics.first_order_steps(steps);
  initial_nodes_ = nodes_;
}

NodeSolution Collocation::initial(double time) const {
  if (beginning_ == Beginning::with_past) return physics_.continued(time);
  return physics_.first_order_step({time - physics_.start().time, NodeEnd::material});
}

VisibleDifference Collocation::error_of_explicit_step(const NodeSolution& end) const {
  NodeSolution reached = end;
  for (std::size_t a = 0; a < reached.vesicles.size(); ++a) {
    const SurfaceFields& from = physics_.start().vesicles[a];
    const Rate::OfVesicle& rate = rates_.front().vesicles[a];
    SurfaceFields& fields = reached.vesicles[a].material;
    if (rate.velocity.size() > 0) fields.position = from.position + dt_ * rate.velocity;
    if (rate.potential.size() > 0) fields.transmembrane_potential = from.transmembrane_potential + dt_ * rate.potential;
    if (rate.poration.size() > 0) fields.poration = from.poration + dt_ * rate.poration;
  }
  return physics_.visible_difference(reached, end);
}

void Collocation::evaluate_rates() {
  former_rates_ = std::move(rates_);
  rates_ = physics_.rates(std::span(nodes_).first(next_at_last_ ? last() : nodes_.size()));
  rates_.insert(rates_.begin(), physics_.rate());
  if (next_at_last_) rates_.push_back(std::move(*next_at_last_));
  next_at_last_.reset();
}

std::optional<InstantaneousDifference> Collocation::change_at_last() const {
  if (former_rates_.empty()) return {};
  return physics_.instantaneous_difference(former_rates_.back(), rates_.back());
}

InstantaneousDifference Collocation::change_to(const NodeSolution& end) {
  next_at_last_ = physics_.rate(end);
  return physics_.instantaneous_difference(rates_.back(), *next_at_last_);
}

/// y_0 + dt Σ_j q_j F_j − y.
Residual Collocation::residual(const Vector& weights, const NodeSolution& y, const std::vector<Rate>& rates) const {
  const State& start = physics_.start();
  Residual residual;
  for (std::size_t a = 0; a < start.vesicles.size(); ++a) {
    const SurfaceFields& from = start.vesicles[a];
    const SurfaceFields& to = y.vesicles[a].material;
    Residual::OfVesicle r{from.position - to.position, from.transmembrane_potential - to.transmembrane_potential,
                          from.free_charge - to.free_charge, from.poration - to.poration};
    for (std::size_t j = 0; j < rates.size(); ++j) {
      const double weight = dt_ * weights[static_cast<Index>(j)];
      const Rate::OfVesicle& rate = rates[j].vesicles[a];
      if (rate.velocity.size() > 0) r.position += weight * rate.velocity;
      if (rate.potential.size() > 0) r.potential += weight * rate.potential;
      if (rate.free_charge.size() > 0) r.free_charge += weight * rate.free_charge;
      if (rate.poration.size() > 0) r.poration += weight * rate.poration;
    }
    residual.vesicles.push_back(std::move(r));
  }
  return residual;
}

ImplicitSolve Collocation::correction(std::size_t m, NodeEnd end) const {
  const Vector weights = rule_.weights.row(static_cast<Index>(m));
  return {&nodes_[m], residual(weights, nodes_[m], rates_), rule_.implicit_sizes[m] * dt_, end};
}

NodeSolution Collocation::corrected(std::size_t m, NodeEnd end) { return physics_.implicit_solve(correction(m, end)); }

std::vector<NodeSolution> Collocation::all_corrected(NodeEnd end) {
  std::vector<ImplicitSolve> solves;
  for (std::size_t m = 0; m < last(); ++m) solves.push_back(correction(m, NodeEnd::material));
  solves.push_back(correction(last(), end));
  return physics_.implicit_solves(solves);
}

NodeSolution Collocation::corrected(const NodeSolution& y, NodeEnd end) {
  const Vector weights = integration_weights(points_of(rule_), place_of(y.time));
  return physics_.implicit_solve({&y, residual(weights, y, rates_), rule_.implicit_sizes.back() * dt_, end});
}

NodeSolution Collocation::corrected_with_rate(const NodeSolution& y, NodeEnd end) {
  std::vector<double> points = points_of(rule_);
  points.push_back(place_of(y.time));
  std::vector<Rate> rates = rates_;
  rates.push_back(physics_.rate(y));
  const Vector weights = integration_weights(points, points.back());
  return physics_.implicit_solve({&y, residual(weights, y, rates), rule_.implicit_sizes.back() * dt_, end});
}

double Collocation::place_of(double time) const { return (time - physics_.start().time) / dt_; }

std::vector<VisibleDifference> Collocation::known_derivatives() const {
  const std::vector<double> points = points_of(rule_);
  std::vector<VisibleDifference> known;
  for (int k = 0; k < static_cast<int>(points.size()); ++k) {
    const Vector of_path = derivative_weights(points, k + 1), of_rates = dt_ * derivative_weights(points, k);
    NodeSolution moved = nodes_.back();
    for (std::size_t a = 0; a < moved.vesicles.size(); ++a) {
      SurfaceFields& fields = moved.vesicles[a].material;
      for (std::size_t j = 0; j < points.size(); ++j) {
        const auto index = static_cast<Index>(j);
        const SurfaceFields& there = j == 0 ? physics_.start().vesicles[a] : nodes_[j - 1].vesicles[a].material;
        fields.position += of_path[index] * there.position;
        const Rate::OfVesicle& rate = rates_[j].vesicles[a];
        if (rate.potential.size() > 0) fields.transmembrane_potential += of_rates[index] * rate.potential;
        if (rate.poration.size() > 0) fields.poration += of_rates[index] * rate.poration;
      }
    }
    known.push_back(physics_.visible_difference(moved, nodes_.back()));
  }
  return known;
}

namespace {

/// @param last  of those that are known
double continued(int k, int last, const std::vector<VisibleDifference>& known, double VisibleDifference::*of,
                 double largest_change) {
  const auto derivative = [&](int i) { return known[static_cast<std::size_t>(i)].*of; };
  // One node knows too little to continue anything.
  if (k <= last || last == 0) return derivative(std::min(k, last));
  const int back = std::min(2, last);
  if (derivative(last - back) <= 0.0) return 0.0;
  const double change =
      std::min(std::sqrt(largest_change), std::pow(derivative(last) / derivative(last - back), 1.0 / back));
  // A sine and its derivatives of the other parity vanish at other times: squares of both add up.
  return std::hypot(derivative(last) * std::pow(change, k - last),
                    derivative(last - 1) * std::pow(change, k - last + 1));
}

/// How large a derivative of F with the time over dt is within the step, times dt: what it would move the last node by.
/// Where nothing tells, each is the last but one times the same, as in a motion that oscillates or dies away; of
/// motions that change by all they are within a step sweeps tell.
/// @param known  see known_derivatives
VisibleDifference derivative(int k, const std::vector<VisibleDifference>& known) {
  const int last = static_cast<int>(known.size()) - 1;
  return {continued(k, last - 1, known, &VisibleDifference::shape, thresholds::largest_change_of_shape),
          continued(k, last, known, &VisibleDifference::potential, thresholds::largest_change_of_potential)};
}

VisibleDifference scaled(double factor, const VisibleDifference& of) {
  return {std::abs(factor) * of.shape, std::abs(factor) * of.potential};
}

}  // namespace

VisibleDifference Collocation::at_most_the_motion(const VisibleDifference& error) const {
  VisibleDifference motion{};
  for (std::size_t m = 0; m < last(); ++m) {
    motion = larger_of(motion, physics_.visible_difference(nodes_[m], nodes_.back()));
  }
  return {std::min(error.shape, motion.shape), std::min(error.potential, motion.potential)};
}

VisibleDifference Collocation::rule_error() const {
  const int n_nodes = static_cast<int>(nodes_.size());
  if (n_nodes < 2) return {};
  const int power = 2 * n_nodes - 1;
  const std::vector<VisibleDifference> known = known_derivatives();
  VisibleDifference error = scaled(integration_error(points_of(rule_), 1.0, power), derivative(power, known));
  // A shape follows what drives it as fast as its tension lets it: within about a step where steps are long.
  error.shape = std::hypot(error.shape, following_error(rule_, 1.0) * derivative(n_nodes, known).shape);
  return at_most_the_motion(error);
}

VisibleDifference Collocation::stage_error() const {
  double largest = 0.0;
  const int power = static_cast<int>(nodes_.size());
  for (const double node : rule_.nodes) {
    largest = std::max(largest, std::abs(integration_error(rule_.nodes, node, power)));
  }
  return at_most_the_motion(scaled(largest, derivative(power, known_derivatives())));
}

VisibleDifference Collocation::rule_error(double time, int n_more) const {
  const double place = place_of(time);
  std::vector<double> points = points_of(rule_);
  for (int i = 0; i < n_more; ++i) points.push_back(place);
  const int power = static_cast<int>(points.size());
  return at_most_the_motion(scaled(integration_error(points, place, power), derivative(power, known_derivatives())));
}

}  // namespace vehd
