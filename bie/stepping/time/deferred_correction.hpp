#pragma once

#include "bie/stepping/time/step_operations.hpp"

namespace vehd {

/// The end of a step.
struct CorrectedNode {
  NodeSolution node;
  double last_correction = 0.0;  ///< StepOperations::difference of what it was before; 0 without a correction
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

}  // namespace vehd
