#pragma once

#include <optional>
#include <vector>

#include "bie/stepping/time/step_operations.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

/// Approximations of y at the nodes of one step and F there: what the sweeps of a deferred correction work on.
class Collocation {
 public:
  /// First-order steps to every node.
  /// @param physics  must outlive it
  /// @param end      of the last node
  /// @throws ConvergenceError naming the solve that failed, as all others
  Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end);

  [[nodiscard]] std::size_t last() const { return nodes_.size() - 1; }
  [[nodiscard]] const NodeSolution& node(std::size_t m) const { return nodes_[m]; }
  NodeSolution& node(std::size_t m) { return nodes_[m]; }
  /// The same before all corrections.
  [[nodiscard]] const NodeSolution& first_order_node(std::size_t m) const { return first_order_nodes_[m]; }

  /// F at the start and at every node.
  void evaluate_rates();
  /// How the last two rates of the last node differ; nothing before there are two.
  [[nodiscard]] std::optional<InstantaneousDifference> change_at_last() const;
  /// How the rate at a correction of the last node differs from that before it. It serves the next evaluation, for
  /// which this has to have become the last node.
  InstantaneousDifference change_to(const NodeSolution& end);
  /// Node m after a correction with the rates as they are: y + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F_j − y).
  [[nodiscard]] NodeSolution corrected(std::size_t m, NodeEnd end);
  /// A solution at any time within the step after a correction with these rates: y + (1 − d dt L)⁻¹ (y_0 + ∫F dt − y),
  /// F being the polynomial through the rates at the start and at every node, and d that of the last node.
  [[nodiscard]] NodeSolution corrected(const NodeSolution& y, NodeEnd end);

 private:
  [[nodiscard]] Residual residual(const Vector& weights, const NodeSolution& y) const;

  StepOperations& physics_;
  const TimeRule& rule_;
  double dt_;
  std::vector<NodeSolution> nodes_;
  std::vector<NodeSolution> first_order_nodes_;
  std::vector<Rate> rates_, former_rates_;
  std::optional<Rate> next_at_last_;  // where it is known already
};

}  // namespace vehd
