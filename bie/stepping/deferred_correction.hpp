#pragma once

#include "bie/stepping/stage.hpp"
#include "bie/stepping/time_rule.hpp"

namespace vehd {

/// The last stage of a step and how far the stage before its last correction was from it.
struct CorrectedStep {
  Stage stage;
  double change = 0.0;  ///< of x over the radius and of V_m over its size, whichever is larger; 0 without a correction
};

/// New shapes that a step of this order evaluates, its end included.
int evaluations_per_step(int order);

/// One step of order 1 … highest_time_order by spectral deferred correction (Dutt, Greengard, Rokhlin 2000) of the
/// first-order stage: with c_m the nodes of the time rule, q_mj its weights and d_m its implicit sizes, each sweep
/// takes
///   y_m ← y_m + (1 − d_m dt L)⁻¹ (y_0 + dt Σ_j q_mj F(y_j) − y_m),   y = (x, V_m) on material points,
/// and gains one order. F is the full instantaneous rate of evaluate(), L the implicit part of the first-order stage at
/// the start of the step. The limit of the sweeps is the collocation method of the rule. One step knows nothing of
/// those before, so its size may jump.
CorrectedStep deferred_correction(const StageContext& context, double dt, int order);

}  // namespace vehd
