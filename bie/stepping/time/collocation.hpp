#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "bie/stepping/time/step_operations.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

/// Of each of the two what is larger.
VisibleDifference larger_of(const VisibleDifference& a, const VisibleDifference& b);

/// What the nodes of a step are before its sweeps: first-order steps, or the past continued.
enum class Beginning { afresh, with_past };

/// Approximations of y at the nodes of one step and F there: what the sweeps of a deferred correction work on.
class Collocation {
 public:
  /// Initial approximations at every node. Nodes do not hear of each other within a sweep.
  /// @param physics  must outlive it
  /// @param end      of the last node of a step that begins afresh; the past goes on with the material
  /// @throws ConvergenceError naming the solve that failed, as all others
  Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end,
              Beginning beginning = Beginning::afresh);

  [[nodiscard]] Beginning beginning() const { return beginning_; }
  [[nodiscard]] std::size_t last() const { return nodes_.size() - 1; }
  [[nodiscard]] const NodeSolution& node(std::size_t m) const { return nodes_[m]; }
  NodeSolution& node(std::size_t m) { return nodes_[m]; }
  /// Takes these for all nodes.
  void replace(std::vector<NodeSolution> nodes) { nodes_ = std::move(nodes); }
  [[nodiscard]] const std::vector<NodeSolution>& nodes() const { return nodes_; }
  /// The same before all corrections.
  [[nodiscard]] const NodeSolution& initial_node(std::size_t m) const { return initial_nodes_[m]; }
  /// Initial approximation at any time within the step.
  [[nodiscard]] NodeSolution initial(double time) const;
  /// What an explicit Euler step is wrong by where this is the end: y_0 + dt F_0 against it.
  [[nodiscard]] VisibleDifference error_of_explicit_step(const NodeSolution& end) const;

  /// F at the start and at every node.
  void evaluate_rates();
  /// How the last two rates of the last node differ; nothing before there are two.
  [[nodiscard]] std::optional<InstantaneousDifference> change_at_last() const;
  /// How the rate at a correction of the last node differs from that before it. It serves the next evaluation, for
  /// which this has to have become the last node.
  InstantaneousDifference change_to(const NodeSolution& end);
  /// Estimated error of the rule itself at the last node, which no sweep takes away; nothing of rules with one node,
  /// whose sweeps change more than that.
  /// Accuracy: within a factor of 2 of a charge in an alternating field (tests/stepping/alternating_charge_test.cpp)
  [[nodiscard]] VisibleDifference rule_error() const;
  /// The same of a solution within the step that is `corrected`.
  /// @param n_more  rates there are beside those at the nodes
  [[nodiscard]] VisibleDifference rule_error(double time, int n_more) const;
  /// Estimated error of the rule at the nodes but the last, where its order is that of its polynomial.
  [[nodiscard]] VisibleDifference stage_error() const;
  /// Node m after a correction with the rates as they are: y + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F_j − y).
  [[nodiscard]] NodeSolution corrected(std::size_t m, NodeEnd end);
  /// The same of all nodes.
  /// @param end  of the last one
  [[nodiscard]] std::vector<NodeSolution> all_corrected(NodeEnd end);
  /// A solution at any time within the step after a correction with these rates: y + (1 − d dt L)⁻¹ (y_0 + ∫F dt − y),
  /// F being the polynomial through the rates at the start and at every node, and d that of the last node.
  [[nodiscard]] NodeSolution corrected(const NodeSolution& y, NodeEnd end);
  /// The same with the rate at y as well, which costs an evaluation.
  [[nodiscard]] NodeSolution corrected_with_rate(const NodeSolution& y, NodeEnd end);

 private:
  [[nodiscard]] ImplicitSolve correction(std::size_t m, NodeEnd end) const;
  [[nodiscard]] Residual residual(const Vector& weights, const NodeSolution& y, const std::vector<Rate>& rates) const;
  /// Derivatives 0, 1, … of F with the time over dt, times dt: what they would move the last node by. Of V_m by the
  /// polynomial through the rates. Of a shape by the path through the start and the nodes, which knows all but the
  /// last, since rates magnify what sweeps have left of something stiff.
  [[nodiscard]] std::vector<VisibleDifference> known_derivatives() const;
  /// An error, or how far the nodes lie apart where that is less: of what relaxes in a small part of the step the rates
  /// are the solvers' errors over that time, and none of it is left in the nodes.
  [[nodiscard]] VisibleDifference at_most_the_motion(const VisibleDifference& error) const;
  [[nodiscard]] double place_of(double time) const;

  StepOperations& physics_;
  const TimeRule& rule_;
  double dt_;
  Beginning beginning_;
  std::vector<NodeSolution> nodes_;
  std::vector<NodeSolution> initial_nodes_;
  std::vector<Rate> rates_, former_rates_;
  std::optional<Rate> next_at_last_;  // where it is known already
};

}  // namespace vehd
