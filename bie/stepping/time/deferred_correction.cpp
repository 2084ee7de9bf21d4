#include "bie/stepping/time/deferred_correction.hpp"

#include <utility>

#include "bie/stepping/time/collocation.hpp"

namespace vehd {

int evaluations_per_step(int order) { return 1 + (order - 1) * static_cast<int>(time_rule(order).nodes.size()); }

CorrectedNode deferred_correction(StepOperations& physics, double dt, int order) {
  const TimeRule rule = time_rule(order);
  Collocation y(physics, rule, dt, order == 1 ? NodeEnd::remapped : NodeEnd::material);
  CorrectedNode result;
  for (int sweep = 1; sweep < order; ++sweep) {
    y.evaluate_rates();
    if (sweep < order - 1) {
      y.replace(y.all_corrected(NodeEnd::material));
      continue;
    }
    // Nodes are independent within a sweep, so the last one alone needs the end of the step.
    NodeSolution corrected = y.corrected(y.last(), NodeEnd::remapped);
    result.last_correction = physics.difference(y.node(y.last()), corrected);
    y.node(y.last()) = std::move(corrected);
  }
  result.node = std::move(y.node(y.last()));
  return result;
}

}  // namespace vehd
