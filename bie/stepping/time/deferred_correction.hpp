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
  double last_correction = 0.0;  ///< difference() from the node before it; 0 without a correction
};

/// Number of new shapes that a step of this order evaluates, its end included.
int evaluations_per_step(int order);

/// One step of order 1 … highest_time_order by spectral deferred correction (Dutt, Greengard and Rokhlin 2000) of the
/// first-order step: with c_m the nodes of the time rule, q_mj its weights and d_m its implicit sizes, each sweep takes
///   y_m ← y_m + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F(y_j) − y_m),   y = (x, V_m) on material points,
/// and gains one order. F is the full instantaneous rate, L the implicit part of the first-order step at the start. The
/// limit of the sweeps is the collocation method of the rule. Former steps are not used, so the size can change
/// abruptly.
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: observed orders above 0.9, 1.5 and 2.5 for orders 1, 2 and 3 on Example 2, above 3.8 and 4.5 for orders 4
/// and 5 on a spheroid where the remap has little effect (tests/stepping/time/time_order_test.cpp)
CorrectedNode deferred_correction(StepOperations& physics, double dt, int order);

/// Sizes δ_k of successive corrections of one quantity, and the error that remains.
///
/// If corrections contract by ρ = δ_k/δ_{k−1}, the later ones add up to δ_k ρ/(1−ρ), the sum of a geometric series: the
/// error after correction k. For ρ ≥ 1/2 they hardly converge and the sum is uncertain; the error is then taken as δ_k,
/// the error before correction k.
class Corrections {
 public:
  void add(double change) { changes_.push_back(change); }
  [[nodiscard]] std::size_t count() const { return changes_.size(); }

  /// Estimated error after correction j = 1, 2, …, past or still to come; 0 if there is none.
  [[nodiscard]] double error_after(std::size_t j) const { return error_after(j, contraction()); }
  /// error_after if each later correction contracts by `ratio`.
  [[nodiscard]] double error_after(std::size_t j, double ratio) const;

  /// δ_j of correction j = 1, 2, …, a past one.
  [[nodiscard]] double change(std::size_t j) const { return changes_[j - 1]; }
  /// ρ of the last correction, 1 as long as it is unknown; at least thresholds::best_contraction.
  [[nodiscard]] double contraction() const;
  /// Whether each correction is less than half of the one before.
  [[nodiscard]] bool converge() const { return contraction() < 0.5; }

 private:
  std::vector<double> changes_;
};

/// Requirements of a step with a tolerance.
struct StepGoal {
  double tolerance = 0.0;
  SnapshotTimes output_times{};  ///< times within the step at which states are needed
};

/// Result of a step with a tolerance.
struct ControlledSweeps {
  std::optional<NodeSolution> end;  ///< if the step is accurate enough
  State state;                      ///< at that end
  std::vector<State> dense_states;  ///< at the output times before that end
  double excess = 0.0;              ///< estimated error over the allowed error
  double factor = 1.0;              ///< size with the least work per unit of time, over the size of this step
};

/// One step by deferred correction that stops once its error is small enough.
///
/// - Predictor: the extrapolation of the last step if that was long enough and its sweeps converged, first-order steps
///   otherwise: they damp stiff components, which an extrapolation amplifies.
/// - Measure of errors: n·δx over the radius, so that points that slide within the membrane do not count, and the error
///   of V_m at material points over its size. Both are multiplied by the factor by which the relative changes of ∫λ dA
///   and q, which follow from shape and V_m, exceed them.
/// - Error of the sweeps: the sum of the geometric series of the corrections still to come, see Corrections.
/// - Error of the rule that the sweeps converge to: from the derivatives of the rates, see rule_error. If it is too
///   large, the step is rejected.
/// - Allowed error: a fixed share of the tolerance for each step, since a membrane relaxes: only the errors of the last
///   few steps remain.
/// - Size of the next step: see cheapest_factor.
/// - States within the step: interpolated, then corrected with the rates at the nodes; if the error is still too large,
///   corrected once more with the rate at that time; if that does not suffice, the step is rejected.
///
/// @param order  there are at most order − 1 sweeps
/// @throws ConvergenceError naming the solve that failed
/// Accuracy: see Evolution
/// Source: sweeps as of deferred_correction; starting values and step sizes of implicit Runge–Kutta methods in Hairer
/// and Wanner 1996, whose filter of the estimate is that of rule_error
ControlledSweeps controlled_sweeps(StepOperations& physics, double dt, int order, const StepGoal& goal);

}  // namespace vehd
