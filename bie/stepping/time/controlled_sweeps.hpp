#pragma once

#include <functional>
#include <limits>
#include <optional>
#include <vector>

#include "bie/stepping/time/collocation.hpp"

namespace vehd {

/// What a step with a tolerance is to deliver.
struct StepGoal {
  double tolerance = 0.0;
  /// By what is wrong with shape and V_m at its end is expected to grow: it may leave so much less of them. Tension and
  /// charge follow from both at every time anew, and what is found within the step is delivered at once.
  double growth = 1.0;
  /// For how long what is wrong with the shape at its end is remembered, with what former steps have left.
  double memory = 0.0;
  /// By which what is wrong at its end counts at most, whatever it grows by.
  double most_weight = std::numeric_limits<double>::infinity();
  double truncation = 0.0;  ///< what a grid of another degree may move the surface by, over the radius
  /// Vesicles whose degree is too low for a state.
  std::function<std::vector<std::size_t>(const State&)> too_coarse = [](const State&) {
    return std::vector<std::size_t>();
  };
  /// When states are wanted before the end of a step that goes that far, ascending.
  std::function<std::vector<double>(double end)> times_before = [](double) { return std::vector<double>(); };
};

/// What became of a step whose sweeps are counted by what they leave.
struct ControlledSweeps {
  std::optional<NodeSolution> end;  ///< where the step is good enough
  State state;                      ///< at that end; with `too_coarse` a guess at it
  std::vector<State> passed;        ///< at the times of the goal
  double excess = 0.0;              ///< estimated error over what the step may leave
  double factor = 1.0;              ///< the size that gets on at the least cost, over that of this step
  /// How the next step begins where it has that size, or the next try of this one where it was not good enough.
  Beginning next_beginning = Beginning::afresh;
  std::vector<std::size_t> too_coarse;  ///< vesicles whose degree is to rise before anything else is tried
};

/// One step by deferred correction that stops where its error is small enough.
///
/// - What counts: the change of the shape along its normal, n·δx over the radius, and that of V_m at material points
///   over its size. Points that slide within the membrane are no error. And ∫λ dA and q, which may magnify what is
///   wrong with both.
/// - Estimate: sweep k changes the end by δ_k; with ρ = δ_k/δ_{k−1} the sweeps to come would change it by δ_k ρ/(1−ρ),
///   the sum of a geometric series, or by δ_k where they hardly contract. This is the error of what is kept. What the
///   last sweep did to tension and charge is continued from those before, or solved for where it might decide.
/// - Rule: what the sweeps converge to has an error of its own, that of its quadrature. It is estimated from the rates
///   at the nodes, and no sweep takes it away: where it is too large the step is given up.
/// - Share: a membrane forgets the errors of all but its last few steps, whatever the time units and however long the
///   run, so each step may leave a fixed share of the tolerance. What is wrong with the shape counts more where it is
///   remembered for more steps, and with V_m where it is expected to grow.
/// - Order: e_j, the error after sweep j, is known for every sweep made and falls like dt^(j+1) at least. The size
///   that makes (1 + sweeps × nodes)/dt smallest is that of the next step; more sweeps are made if need be.
/// - Beginning: where motions are smooth, the polynomial through the nodes of the last step tells those of this one
///   tens to thousands of times more exactly than first-order steps, which saves these and one or two sweeps. What it
///   makes of rounding and of what solvers leave is larger than that, so that near rest and after jumps steps begin
///   afresh; what the next step does is decided by what both would cost, see next_step.
/// - Degree: judged at the end of the first-order step already, before any sweep is paid for. The past continued has
///   high degrees of its own, and a step that begins with it is judged at its end.
///
/// @param order  sweeps are order − 1 at most
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: see Evolution
/// Source: sweeps as of deferred_correction; the past continued as starting values of implicit Runge–Kutta methods and
/// the step-size law in Hairer and Wanner 1996; the control is of this project
ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal);

}  // namespace vehd
