#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "bie/stepping/time/step_operations.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

/// Initial solutions at the nodes of a step: first-order steps, or the extrapolation of the last step.
enum class Predictor { euler, extrapolation };

/// Approximations of y at the nodes of one step and the rates F there, on which the sweeps of a deferred correction
/// work.
class Collocation {
 public:
  /// Initial approximations at every node. Nodes are independent within a sweep.
  /// @param physics  must outlive it
  /// @param end      of the last node of an Euler predictor; extrapolated nodes stay with the material
  /// @throws ConvergenceError naming the solve that failed, as do all other members
  Collocation(StepOperations& physics, const TimeRule& rule, double dt, NodeEnd end,
              Predictor predictor = Predictor::euler);

  [[nodiscard]] std::size_t last() const { return nodes_.size() - 1; }
  [[nodiscard]] const NodeSolution& node(std::size_t m) const { return nodes_[m]; }
  NodeSolution& node(std::size_t m) { return nodes_[m]; }
  /// Replaces the solutions at all nodes.
  void replace(std::vector<NodeSolution> nodes) { nodes_ = std::move(nodes); }
  [[nodiscard]] const std::vector<NodeSolution>& nodes() const { return nodes_; }
  /// F at the start and at every node.
  void evaluate_rates();
  /// Difference of the last two rates at the last node; nothing before there are two.
  [[nodiscard]] std::optional<InstantaneousDifference> change_at_last() const;
  /// Derivatives 1 … M of F with respect to t/dt, times dt, filtered by the implicit solve of the last node:
  /// (1 − d_M dt L)⁻¹ dt d^kF, from the polynomial through the rates. Unfiltered, errors of stiff components would
  /// dominate them, although the solution hardly has these errors.
  [[nodiscard]] std::vector<VisibleDifference> derivatives() const;
  /// Node m after a correction with the current rates: y + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F_j − y).
  [[nodiscard]] NodeSolution corrected(std::size_t m, NodeEnd end) const;
  /// All nodes after such a correction.
  /// @param end  of the last one
  [[nodiscard]] std::vector<NodeSolution> all_corrected(NodeEnd end) const;
  /// y at any time within the step, at its material points, before a correction: the predictor at this time plus the
  /// polynomial through the corrections of the nodes so far. First-order steps follow stiff components that decay
  /// within the step; a polynomial through the start would carry them to the end.
  [[nodiscard]] NodeSolution within(double time) const;
  /// A solution at any time within the step after a correction with these rates: y + (1 − d dt L)⁻¹ (y_0 + ∫F dt − y),
  /// F being the polynomial through the rates at the start and at every node, and d that of the last node.
  [[nodiscard]] NodeSolution corrected(const NodeSolution& y, NodeEnd end) const;
  /// `corrected` with the rate at y as well, which costs an evaluation.
  [[nodiscard]] NodeSolution corrected_with_rate(const NodeSolution& y, NodeEnd end) const;

 private:
  [[nodiscard]] ImplicitSolve correction(std::size_t m, NodeEnd end) const;
  [[nodiscard]] NodeSolution solved(const ImplicitSolve& solve) const;
  [[nodiscard]] NodeSolution predicted(double time) const;
  [[nodiscard]] std::vector<Unknowns> residual(const Vector& weights, const NodeSolution& y,
                                               const std::vector<Rate>& rates) const;
  [[nodiscard]] double place_of(double time) const;

  StepOperations& physics_;
  const TimeRule& rule_;
  double dt_;
  Predictor predictor_;
  std::vector<NodeSolution> nodes_;
  std::vector<NodeSolution> predicted_;
  std::vector<Rate> rates_, former_rates_;
};

/// Estimated error of shape or V_m at the end of a step after converged sweeps, that of the rule itself; 0 for rules
/// with one node, whose corrections are larger than this error.
/// @param derivatives  see Collocation
/// Accuracy: within a factor of 2 for a charge in an alternating field (tests/stepping/alternating_charge_test.cpp)
double rule_error(const TimeRule& rule, const std::vector<VisibleDifference>& derivatives);

/// Estimated error of shape or V_m of a solution within the step, corrected with the rates at these points.
/// @param place  its time after the start, over dt
double rule_error(const std::vector<double>& points, double place, const std::vector<VisibleDifference>& derivatives);

}  // namespace vehd
