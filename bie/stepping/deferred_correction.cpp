#include "bie/stepping/deferred_correction.hpp"

#include <algorithm>
#include <vector>

#include "bie/stepping/discretisation.hpp"
#include "bie/stepping/evaluation_parts.hpp"
#include "bie/stepping/resolution.hpp"
#include "bie/stepping/rigid_sphere.hpp"
#include "bie/stepping/time_rule.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

/// F at one point.
struct Rate {
  Matrix velocity;
  Vector potential;
};

Rate rate_of(const Evaluation& evaluation) {
  const Evaluation::Parts& parts = *evaluation.parts;
  return {parts.is_sphere ? rigid_sphere_velocity(parts.membrane, parts.velocity) : parts.velocity,
          evaluation.potential_rate};
}

/// y_0 + dt Σ_j q_j F_j − y.
StageResidual residual_of(const State& start, const Stage& stage, const std::vector<Rate>& rates,
                          const Eigen::RowVectorXd& weights, double dt) {
  StageResidual residual{start.position - stage.move.position, start.transmembrane_potential - stage.potential};
  for (std::size_t j = 0; j < rates.size(); ++j) {
    const double weight = dt * weights[static_cast<Index>(j)];
    if (rates[j].velocity.size() > 0) residual.position += weight * rates[j].velocity;
    if (rates[j].potential.size() > 0) residual.potential += weight * rates[j].potential;
  }
  return residual;
}

/// Largest change of x over the radius and of V_m over its scale.
double change_of(const StageContext& context, const Stage& before, const Stage& after) {
  const SphereTransform& fine = context.discretisation.fine_transform();
  const double radius = context.evaluation.parts->membrane.radius;
  const Matrix moved = fine.synthesize(after.move.position - before.move.position);
  const double change = moved.rowwise().norm().maxCoeff() / radius;
  if (!context.model.electric) return change;
  const double largest = fine.synthesize(after.potential).cwiseAbs().maxCoeff();
  const double scale = potential_scale(*context.model.electric, radius, largest);
  return std::max(change, fine.synthesize(after.potential - before.potential).cwiseAbs().maxCoeff() / scale);
}

}  // namespace

int evaluations_per_step(int order) { return 1 + (order - 1) * static_cast<int>(time_rule(order).nodes.size()); }

CorrectedStep deferred_correction(const StageContext& context, double dt, int order) {
  const TimeRule rule = time_rule(order);
  const std::size_t last = rule.nodes.size() - 1;
  int iterations_flow = 0;
  int iterations_electric = 0;
  CorrectedStep result;
  const auto keep = [&](Stage& to, Stage stage) {
    iterations_flow += stage.iterations_flow;
    iterations_electric += stage.iterations_electric;
    to = std::move(stage);
    return to.accepted;
  };
  std::vector<Stage> stages(rule.nodes.size());
  for (std::size_t m = 0; m <= last; ++m) {
    const StageEnd end = order == 1 ? StageEnd::reparametrised : StageEnd::material;
    if (!keep(stages[m], first_order_stage(context, rule.nodes[m] * dt, end))) return {stages[m]};
  }
  for (int sweep = 1; sweep < order; ++sweep) {
    std::vector<Rate> rates{rate_of(context.evaluation)};
    for (const Stage& stage : stages) {
      const Evaluation evaluation = evaluate(context.model, context.discretisation, stage_state(context, stage),
                                             context.instruments, &context.evaluation, Limit::before);
      iterations_flow += evaluation.iterations_flow;
      iterations_electric += evaluation.iterations_electric;
      rates.push_back(rate_of(evaluation));
    }
    const bool finishes = sweep == order - 1;
    // Nodes do not hear of each other within a sweep, so the last one needs its end alone.
    for (std::size_t m = finishes ? last : 0; m <= last; ++m) {
      const StageResidual residual =
          residual_of(context.state, stages[m], rates, rule.weights.row(static_cast<Index>(m)), dt);
      Stage corrected;
      const StageEnd end = finishes ? StageEnd::reparametrised : StageEnd::material;
      if (!keep(corrected, corrected_stage(context, stages[m], residual, rule.implicit_sizes[m] * dt, end)))
        return {corrected};
      if (finishes) result.change = change_of(context, stages[m], corrected);
      stages[m] = std::move(corrected);
    }
  }
  result.stage = std::move(stages[last]);
  result.stage.iterations_flow = iterations_flow;
  result.stage.iterations_electric = iterations_electric;
  return result;
}

}  // namespace vehd
