#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "bie/stepping/time/collocation.hpp"
#include "bie/stepping/time/events.hpp"

namespace vehd {

/// The end of a step.
struct CorrectedNode {
  NodeSolution node;
  double last_correction = 0.0;  ///< difference() to what it was before; 0 without a correction
};

/// New shapes that a step of this order evaluates, its end included.
int evaluations_per_step(int order);

/// One step of order 1 … highest_time_order by spectral deferred correction (Dutt, Greengard and Rokhlin 2000) of the
/// first-order step: with c_m the nodes of the time rule, q_mj its weights and d_m its implicit sizes, each sweep
/// takes
///   y_m ← y_m + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F(y_j) − y_m),   y = (x, V_m) on material points,
/// and gains one order. F is the full instantaneous rate, L the implicit part of the first-order step at the
/// start. The limit of the sweeps is the collocation method of the rule. One step knows nothing of
/// those before, so its size may jump.
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: observed orders above 0.9, 1.5 and 2.5 for orders 1, 2 and 3 on Example 2, above 3.8 and 4.5 for orders 4
/// and 5 on a spheroid where remap costs little (tests/stepping/time/time_order_test.cpp)
CorrectedNode deferred_correction(StepOperations& physics, double dt, int order);

/// Sizes δ_k of successive corrections of one quantity, and the error that they leave.
///
/// If corrections contract by ρ = δ_k/δ_{k−1}, those to come add up to δ_k ρ/(1−ρ), the sum of a geometric series: the
/// error after correction k. For ρ ≥ 1/2 they hardly converge and the sum is uncertain; the error is taken as δ_k, that
/// before correction k.
class Corrections {
 public:
  void add(double change) { changes_.push_back(change); }
  [[nodiscard]] std::size_t count() const { return changes_.size(); }

  /// Estimated error after correction j = 1, 2, …, made or yet to be made; 0 if there is none.
  [[nodiscard]] double error_after(std::size_t j) const { return error_after(j, contraction()); }
  /// error_after if each later correction contracts by `ratio`.
  [[nodiscard]] double error_after(std::size_t j, double ratio) const;

  /// δ_j of correction j = 1, 2, …, one that was made.
  [[nodiscard]] double change(std::size_t j) const { return changes_[j - 1]; }
  /// ρ of the last correction, 1 as long as it is not known; at least thresholds::best_contraction.
  [[nodiscard]] double contraction() const;
  /// Whether each correction is less than half of the one before.
  [[nodiscard]] bool converge() const { return contraction() < 0.5; }

 private:
  std::vector<double> changes_;
};

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
///   steps only those of the last few are left.
/// - Size of the next step: see cheapest_factor.
/// - States within the step: interpolated, then corrected with the rates at the nodes; where the error is still too
///   large corrected once more with the rate at that time; the step is rejected where that does not suffice.
///
/// @param order  sweeps are order − 1 at most
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: see Evolution
/// Source: sweeps as of deferred_correction; starting values and step sizes of implicit Runge–Kutta methods in Hairer
/// and Wanner 1996, whose filter of the estimate rule_error takes up
ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal);

}  // namespace vehd
