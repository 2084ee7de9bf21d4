#pragma once

#include <optional>
#include <vector>

#include "bie/stepping/time/collocation.hpp"
#include "bie/stepping/time/snapshot_times.hpp"

namespace vehd {

/// Requirements of a step with a tolerance.
struct StepGoal {
  double tolerance = 0.0;
  SnapshotTimes moments{};  ///< at which states within the step are needed
};

/// Result of a step with a tolerance.
struct ControlledSweeps {
  std::optional<NodeSolution> end;  ///< where the step is good enough
  State state;                      ///< at that end
  std::vector<State> passed;        ///< at the moments of the goal before it
  double excess = 0.0;              ///< estimated error over the error that is allowed
  double factor = 1.0;              ///< size with the least work for a unit of time, over the size of this step
};

/// One step by deferred correction that stops where its error is small enough.
///
/// - Predictor: the extrapolation of the last step where that was long enough and its sweeps converged, first-order
///   steps otherwise: they damp stiff components, which an extrapolation amplifies.
/// - Measure of errors: n·δx over the radius, so that points that slide within the membrane do not count, and the error
///   of V_m at material points over its size. Both are multiplied by how much larger the relative changes of ∫λ dA and
///   q are, which follow from shape and V_m.
/// - Error of the sweeps: the sum of the geometric series of the corrections to come, see Corrections.
/// - Error of the rule that the sweeps converge to: from the derivatives of the rates, see rule_error. Where it is too
///   large the step is rejected.
/// - Allowed error: a fixed share of the tolerance for each step, since a membrane relaxes: of the errors of earlier
/// steps
///   only those of the last few are left.
/// - Size: the error after sweep j falls like dt^(j+1), with an extrapolation through M nodes like dt^(j+1+M). The next
///   step has the size with the least (1 + M j)/dt, evaluations for a unit of time.
/// - States within the step: interpolated, then corrected with the rates at the nodes; where the error is still too
/// large
///   corrected once more with the rate at that time; the step is rejected where that does not suffice.
///
/// @param order  sweeps are order − 1 at most
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: see Evolution
/// Source: sweeps as of deferred_correction; starting values and step sizes of implicit Runge–Kutta methods in Hairer
/// and Wanner 1996, whose filter of the estimate rule_error takes up
ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal);

}  // namespace vehd
