#include "bie/stepping/time/deferred_correction.hpp"

#include <utility>
#include <vector>

#include "bie/stepping/time/time_rule.hpp"

namespace vehd {

namespace {

/// y_0 + dt Σ_j q_j F_j − y.
Residual residual_of(const State& start, const NodeSolution& y, const std::vector<Rate>& rates,
                     const Eigen::RowVectorXd& weights, double dt) {
  Residual residual;
  for (std::size_t a = 0; a < start.vesicles.size(); ++a) {
    const SurfaceFields& from = start.vesicles[a];
    const SurfaceFields& to = y.vesicles[a].material;
    Residual::OfVesicle r{from.position - to.position, from.transmembrane_potential - to.transmembrane_potential};
    for (std::size_t j = 0; j < rates.size(); ++j) {
      const double weight = dt * weights[static_cast<Index>(j)];
      const Rate::OfVesicle& rate = rates[j].vesicles[a];
      if (rate.velocity.size() > 0) r.position += weight * rate.velocity;
      if (rate.potential.size() > 0) r.potential += weight * rate.potential;
    }
    residual.vesicles.push_back(std::move(r));
  }
  return residual;
}

}  // namespace

int evaluations_per_step(int order) { return 1 + (order - 1) * static_cast<int>(time_rule(order).nodes.size()); }

CorrectedNode deferred_correction(StepOperations& physics, double dt, int order) {
  const TimeRule rule = time_rule(order);
  const std::size_t last = rule.nodes.size() - 1;
  const auto end_of_sweep = [&](int sweep) { return sweep == order - 1 ? NodeEnd::remapped : NodeEnd::material; };
  std::vector<NodeSolution> y;
  for (const double c : rule.nodes) y.push_back(physics.first_order_step(c * dt, end_of_sweep(0)));
  CorrectedNode result;
  for (int sweep = 1; sweep < order; ++sweep) {
    std::vector<Rate> rates{physics.rate()};
    for (const NodeSolution& node : y) rates.push_back(physics.rate(node));
    // Nodes do not hear of each other within a sweep, so the last one needs its end alone.
    for (std::size_t m = sweep == order - 1 ? last : 0; m <= last; ++m) {
      const Residual r = residual_of(physics.start(), y[m], rates, rule.weights.row(static_cast<Index>(m)), dt);
      NodeSolution corrected = physics.implicit_solve(y[m], r, rule.implicit_sizes[m] * dt, end_of_sweep(sweep));
      if (sweep == order - 1) result.last_correction = physics.difference(y[m], corrected);
      y[m] = std::move(corrected);
    }
  }
  result.node = std::move(y[last]);
  return result;
}

}  // namespace vehd
