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
    const bool is_last = sweep == order - 1;
    // Nodes do not hear of each other within a sweep, so the last one needs its end alone.
    for (std::size_t m = is_last ? y.last() : 0; m <= y.last(); ++m) {
      NodeSolution corrected = y.corrected(m, is_last ? NodeEnd::remapped : NodeEnd::material);
      if (is_last) result.last_correction = physics.difference(y.node(m), corrected);
      y.node(m) = std::move(corrected);
    }
  }
  result.node = std::move(y.node(y.last()));
  return result;
}

}  // namespace vehd
