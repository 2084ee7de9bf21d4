#include "bie/stepping/time/collocation.hpp"

#include <utility>

namespace vehd {

Collocation::Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end)
    : physics_(physics), rule_(rule), dt_(dt) {
  for (std::size_t m = 0; m < rule.nodes.size(); ++m) {
    const bool is_last = m + 1 == rule.nodes.size();
    nodes_.push_back(physics.first_order_step(rule.nodes[m] * dt, is_last ? end : NodeEnd::material));
  }
  first_order_nodes_ = nodes_;
}

void Collocation::evaluate_rates() {
  former_rates_ = std::move(rates_);
  rates_ = {physics_.rate()};
  for (std::size_t m = 0; m < last(); ++m) rates_.push_back(physics_.rate(nodes_[m]));
  rates_.push_back(next_at_last_ ? std::move(*next_at_last_) : physics_.rate(nodes_.back()));
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
Residual Collocation::residual(const Vector& weights, const NodeSolution& y) const {
  const State& start = physics_.start();
  Residual residual;
  for (std::size_t a = 0; a < start.vesicles.size(); ++a) {
    const SurfaceFields& from = start.vesicles[a];
    const SurfaceFields& to = y.vesicles[a].material;
    Residual::OfVesicle r{from.position - to.position, from.transmembrane_potential - to.transmembrane_potential,
                          from.free_charge - to.free_charge, from.poration - to.poration};
    for (std::size_t j = 0; j < rates_.size(); ++j) {
      const double weight = dt_ * weights[static_cast<Index>(j)];
      const Rate::OfVesicle& rate = rates_[j].vesicles[a];
      if (rate.velocity.size() > 0) r.position += weight * rate.velocity;
      if (rate.potential.size() > 0) r.potential += weight * rate.potential;
      if (rate.free_charge.size() > 0) r.free_charge += weight * rate.free_charge;
      if (rate.poration.size() > 0) r.poration += weight * rate.poration;
    }
    residual.vesicles.push_back(std::move(r));
  }
  return residual;
}

NodeSolution Collocation::corrected(std::size_t m, NodeEnd end) {
  const Vector weights = rule_.weights.row(static_cast<Index>(m));
  return physics_.implicit_solve(nodes_[m], residual(weights, nodes_[m]), rule_.implicit_sizes[m] * dt_, end);
}

NodeSolution Collocation::corrected(const NodeSolution& y, NodeEnd end) {
  const Vector weights = integration_weights(rule_, (y.time - physics_.start().time) / dt_);
  return physics_.implicit_solve(y, residual(weights, y), rule_.implicit_sizes.back() * dt_, end);
}

}  // namespace vehd
