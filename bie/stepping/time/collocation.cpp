#include "bie/stepping/time/collocation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/stepping/time/past.hpp"

namespace vehd {

namespace {

/// Largest ratio of successive derivatives with respect to t/dt that is extrapolated: a faster growth is a jump.
/// Measured.
constexpr double largest_derivative_ratio = 8.0;

}  // namespace

Collocation::Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end, Predictor predictor)
    : physics_(physics), rule_(rule), dt_(dt), predictor_(predictor) {
  if (predictor == Predictor::extrapolation) {
    for (const double node : rule.nodes) nodes_.push_back(predicted(physics.start().state.time + node * dt));
    predicted_ = nodes_;
    return;
  }
  std::vector<FirstOrderStep> steps;
  for (const double node : rule.nodes) steps.push_back({node * dt, NodeEnd::material});
  steps.back().end = end;
  nodes_ = physics.first_order_steps(steps);
  predicted_ = nodes_;
}

NodeSolution Collocation::predicted(double time) const {
  if (predictor_ == Predictor::extrapolation) return extrapolated(physics_.start(), time);
  return physics_.first_order_steps({{time - physics_.start().state.time, NodeEnd::material}}).front();
}

NodeSolution Collocation::within(double time) const {
  const Vector nodes = Eigen::Map<const Vector>(rule_.nodes.data(), std::ssize(rule_.nodes));
  const Vector weights = weights_from_zero(nodes, place_of(time));
  NodeSolution result = predicted(time);
  for (std::size_t a = 0; a < result.vesicles.size(); ++a) {
    SurfaceFields& fields = result.vesicles[a].material;
    for (std::size_t m = 0; m <= last(); ++m) {
      const double weight = weights[static_cast<Index>(m)];
      axpy(weight, nodes_[m].vesicles[a].material, fields);
      axpy(-weight, predicted_[m].vesicles[a].material, fields);
    }
    // Initial guess of the next solve.
    fields.tension = nodes_.back().vesicles[a].material.tension;
  }
  return result;
}

void Collocation::evaluate_rates() {
  former_rates_ = std::move(rates_);
  rates_ = physics_.rates(nodes_);
  rates_.insert(rates_.begin(), rate_of(physics_.start().solved));
}

std::optional<InstantaneousDifference> Collocation::change_at_last() const {
  if (former_rates_.empty()) return {};
  const StepStart& start = physics_.start();
  return instantaneous_difference(start.model, start.solved, former_rates_.back(), rates_.back());
}

namespace {

/// Adds Σ_j w_j F_j.
void add_rates(const Vector& weights, const std::vector<Rate>& rates, std::vector<Unknowns>& sum) {
  for (std::size_t j = 0; j < rates.size(); ++j) {
    for (std::size_t a = 0; a < sum.size(); ++a) axpy(weights[static_cast<Index>(j)], rates[j].unknowns[a], sum[a]);
  }
}

}  // namespace

/// y_0 + dt Σ_j q_j F_j − y.
std::vector<Unknowns> Collocation::residual(const Vector& weights, const NodeSolution& y,
                                            const std::vector<Rate>& rates) const {
  std::vector<Unknowns> residual;
  for (std::size_t a = 0; a < y.vesicles.size(); ++a) {
    residual.push_back(physics_.start().state.vesicles[a] - y.vesicles[a].material);
  }
  add_rates(dt_ * weights, rates, residual);
  return residual;
}

ImplicitSolve Collocation::correction(std::size_t m, NodeEnd end) const {
  const Vector weights = rule_.weights.row(static_cast<Index>(m));
  return {&nodes_[m], residual(weights, nodes_[m], rates_), rule_.implicit_sizes[m] * dt_, end};
}

NodeSolution Collocation::corrected(std::size_t m, NodeEnd end) const { return solved(correction(m, end)); }

NodeSolution Collocation::solved(const ImplicitSolve& solve) const {
  return std::move(physics_.implicit_solves({solve}).front());
}

std::vector<NodeSolution> Collocation::all_corrected(NodeEnd end) const {
  std::vector<ImplicitSolve> solves;
  for (std::size_t m = 0; m < last(); ++m) solves.push_back(correction(m, NodeEnd::material));
  solves.push_back(correction(last(), end));
  return physics_.implicit_solves(solves);
}

NodeSolution Collocation::corrected(const NodeSolution& y, NodeEnd end) const {
  const Vector weights = integration_weights(points_of(rule_), place_of(y.time));
  return solved({&y, residual(weights, y, rates_), rule_.implicit_sizes.back() * dt_, end});
}

NodeSolution Collocation::corrected_with_rate(const NodeSolution& y, NodeEnd end) const {
  std::vector<double> points = points_of(rule_);
  points.push_back(place_of(y.time));
  std::vector<Rate> rates = rates_;
  rates.push_back(std::move(physics_.rates({&y, 1}).front()));
  const Vector weights = integration_weights(points, points.back());
  return solved({&y, residual(weights, y, rates), rule_.implicit_sizes.back() * dt_, end});
}

double Collocation::place_of(double time) const { return (time - physics_.start().state.time) / dt_; }

std::vector<VisibleDifference> Collocation::derivatives() const {
  const NodeSolution& end = nodes_.back();
  std::vector<VisibleDifference> result;
  for (int k = 1; k <= static_cast<int>(nodes_.size()); ++k) {
    std::vector<Unknowns> moved(end.vesicles.size());
    add_rates(dt_ * derivative_weights(points_of(rule_), k), rates_, moved);
    // One at a time, because solves of one size share their systems.
    const NodeSolution followed =
        solved({&end, std::move(moved), rule_.implicit_sizes.back() * dt_, NodeEnd::material});
    result.push_back(visible_difference(physics_.start(), end, followed));
  }
  return result;
}

namespace {

/// Derivative k ≥ 1 of shape or V_m. Beyond the known derivatives the last one is extrapolated with the mean ratio of
/// the known ones, as in a motion that oscillates or decays.
double derivative(int k, const std::vector<VisibleDifference>& known, double VisibleDifference::*of) {
  const auto at = [&](int i) { return known[static_cast<std::size_t>(i - 1)].*of; };
  const int last = static_cast<int>(known.size());
  if (k <= last) return at(k);
  if (last < 2 || at(1) <= 0.0) return at(last);
  const double ratio = std::min(largest_derivative_ratio, std::pow(at(last) / at(1), 1.0 / (last - 1.0)));
  return at(last) * std::pow(ratio, k - last);
}

double error_of_rule(const std::vector<double>& points, double place, int power,
                     const std::vector<VisibleDifference>& derivatives) {
  return std::abs(integration_error(points, place, power)) *
         std::max(derivative(power, derivatives, &VisibleDifference::shape),
                  derivative(power, derivatives, &VisibleDifference::potential));
}

}  // namespace

double rule_error(const TimeRule& rule, const std::vector<VisibleDifference>& derivatives) {
  const int n_nodes = static_cast<int>(rule.nodes.size());
  return n_nodes < 2 ? 0.0 : error_of_rule(points_of(rule), 1.0, 2 * n_nodes - 1, derivatives);
}

double rule_error(const std::vector<double>& points, double place, const std::vector<VisibleDifference>& derivatives) {
  return error_of_rule(points, place, static_cast<int>(points.size()), derivatives);
}

}  // namespace vehd
