#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bie/stepping/constrained_move.hpp"

namespace vehd {

/// The linearised systems of one step, one for each implicit size; sweeps return to the same sizes.
class FlowSystems {
 public:
  /// @param options              with the tension at the start of the step as the one to hold
  /// @param explicit_relaxation  of that tension, the part is not held under which a sphere relaxes by this much in dt
  /// @param known                of FlowMemory
  FlowSystems(const Model& model, const Membrane& membrane, FlowOptions options, double explicit_relaxation,
              std::shared_ptr<const ScalarResponses> known);
  [[nodiscard]] FlowSystem& of(double dt);
  /// What was known and what has been learned, for the next step.
  [[nodiscard]] std::shared_ptr<const ScalarResponses> known() const;

 private:
  const Model& model_;
  const Membrane& membrane_;
  FlowOptions options_;
  double explicit_tension_time_;  ///< times the dt of a system: the tension that is not held
  std::shared_ptr<const ScalarResponses> known_;
  std::vector<std::pair<double, FlowSystem>> systems_;  // in the order in which they were asked for
};

/// One frozen evaluation from which stages start.
struct StageContext {
  const Model& model;
  const Discretisation& discretisation;
  const State& state;
  const Evaluation& evaluation;
  FlowSystems& flow;
  Instruments& instruments;
};

/// The systems of a step from this evaluation.
FlowSystems flow_systems(const Model& model, const Discretisation& discretisation, const Evaluation& evaluation);

/// Where one implicit solve arrives, at the material points of the step's start.
struct Stage {
  bool accepted = false;
  std::string reason;    ///< why there is none
  double time = 0.0;     ///< of arrival
  ConstrainedMove move;  ///< that of the start where the shape is frozen
  Vector potential;      ///< V_m; empty without electricity
  int iterations_flow = 0;
  int iterations_electric = 0;
};

/// What a stage is for: within a step fields stay with the material; at its end they are carried to new nodes.
enum class StageEnd { material, reparametrised };

/// The paper's semi-implicit step, Eqs. (27)–(31), of size dt from the start.
Stage first_order_stage(const StageContext& context, double dt, StageEnd end);

/// What an approximate stage lacks.
struct StageResidual {
  Matrix position;
  Vector potential;
};

/// The stage plus (1 − dt L)⁻¹ of its residual, L the implicit operators of the first-order step at the start.
Stage corrected_stage(const StageContext& context, const Stage& stage, const StageResidual& residual, double dt,
                      StageEnd end);

/// The state at the end of a step from its last stage, which must be reparametrised.
State arrived_state(const StageContext& context, const Stage& stage);

/// The state at the material points of a stage within the step.
State stage_state(const StageContext& context, const Stage& stage);

}  // namespace vehd
