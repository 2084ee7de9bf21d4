#pragma once

#include <vector>

#include "bie/stepping/time/collocation.hpp"

namespace vehd {

/// y within a step, on the material points of its start: the first-order step to that time and a polynomial of what the
/// corrections have changed. What is stiff and dies away within the step is in the former; a polynomial through the
/// start would carry it on to the end.
class StepPolynomial {
 public:
  /// @param y  with its last sweep made; must outlive the polynomial, as the physics
  StepPolynomial(StepOperations& physics, const TimeRule& rule, double dt, const Collocation& y);

  /// What the polynomial is fitted to, each an order better than the one before: all nodes but the first; all; these
  /// and the rate at the start, where the first-order step has the right one.
  enum class Fit { later_nodes, nodes, nodes_and_rate };

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

  StepOperations& physics_;
  const TimeRule& rule_;
  const Collocation& y_;
  double dt_;
};

}  // namespace vehd
