#pragma once

#include <vector>

#include "bie/stepping/time/collocation.hpp"

namespace vehd {

/// y within a step, on the material points of its start: what the step began with, at that time, and a polynomial of
/// what the corrections have changed. What is stiff and dies away within the step is in first-order steps; a polynomial
/// through the start would carry it on to the end.
class StepPolynomial {
 public:
  /// @param y  with its last sweep made; must outlive the polynomial, as the physics
  StepPolynomial(StepOperations& physics, const TimeRule& rule, double dt, const Collocation& y);

  /// What the polynomial is fitted to, each an order better than the one before: the last node; all but the first; all;
  /// these and the rate at the start. The last only after first-order steps, which have that rate: what is wrong with
  /// that of a past, rounding and what solvers leave, the others take away.
  enum class Fit { last_node, later_nodes, nodes, nodes_and_rate };

  /// Estimated error of `at` at a time, of the shape or V_m: from how much each fit differs from the one before.
  [[nodiscard]] double error(double time) const;
  /// The same between the last two nodes, where it is largest.
  [[nodiscard]] double error() const;

  /// @param time  within the step
  /// @throws ConvergenceError naming the solve that failed
  /// Accuracy: twice the tolerance at every order from 3 (tests/stepping/moments_test.cpp)
  [[nodiscard]] NodeSolution at(double time) const;

 private:
  void correct(NodeSolution& solution, Fit fit) const;
  /// Those that there are, the best one last.
  [[nodiscard]] std::vector<Fit> fits() const;

  StepOperations& physics_;
  const TimeRule& rule_;
  const Collocation& y_;
  double dt_;
};

}  // namespace vehd
