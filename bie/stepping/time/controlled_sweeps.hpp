#pragma once

#include <optional>
#include <vector>

#include "bie/stepping/time/collocation.hpp"
#include "bie/stepping/time/snapshot_times.hpp"

namespace vehd {

/// What a step with a tolerance is to deliver.
struct StepGoal {
  double tolerance = 0.0;
  SnapshotTimes moments{};  ///< at which states within the step are wanted
};

/// What became of a step whose sweeps are counted by what they leave.
struct ControlledSweeps {
  std::optional<NodeSolution> end;  ///< where the step is good enough
  State state;                      ///< at that end
  std::vector<State> passed;        ///< at the moments of the goal before it
  double excess = 0.0;              ///< estimated error over what the step may leave
  double factor = 1.0;              ///< the size that gets on at the least cost, over that of this step
};

/// One step by deferred correction that stops where its error is small enough.
///
/// - Predictor: the extrapolation of the last step where that was long enough and its sweeps converged, first-order
///   steps otherwise: these damp what is stiff, an extrapolation magnifies it.
/// - What counts: the change of the shape along its normal, n·δx over the radius, and that of V_m at material points
///   over its size; points that slide within the membrane are no error. And ∫λ dA and q, which follow from both and
///   may magnify what is wrong with them.
/// - Error of the sweeps: of each of these the sum of the geometric series of the corrections to come, see Corrections.
/// - Error of the rule that the sweeps converge to: from the derivatives of the rates, see rule_error. No sweep takes
///   it away: where it is too large the step is given up.
/// - Share: a membrane forgets the errors of all but its last few steps, whatever the time units and however long the
///   run, so each step may leave a fixed share of the tolerance.
/// - Size: the error after sweep j falls like dt^(j+1), with an extrapolation through M nodes like dt^(j+1+M). The next
///   step has the size for which (1 + M j)/dt, the evaluations for a unit of time, is least.
/// - Moments: what polynomials tell of a time within the step, corrected by the rates at the nodes, and where that is
///   not enough with the rate there. Where that is not enough either the step is given up.
///
/// @param order  sweeps are order − 1 at most
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: see Evolution
/// Source: sweeps as of deferred_correction; starting values and step sizes of implicit Runge–Kutta methods in Hairer
/// and Wanner 1996, whose filter of the estimate rule_error takes up
ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal);

}  // namespace vehd
