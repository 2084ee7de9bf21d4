#include "bie/estimate/sweep_cost.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

#include "bie/estimate/cost.hpp"

namespace vehd {
namespace {

/// A text that is equal for scenes whose steps cost the same.
std::string cost_class(const Scene& scene, const RunPlan& plan) {
  std::string text = fmt::format("{} {} {} {} {}", plan.unknowns, plan.symmetry, plan.shapes_per_step,
                                 plan.kernel_evaluations, scene.numerics.tolerance.value_or(0.0));
  for (const PlannedOperator& op : plan.operators) text += fmt::format(" {} {}", op.name, op.n_vesicles);
  return text;
}

/// A plan with its predicted cost, and the end time of its scene.
struct CostedPlan {
  RunPlan plan;
  double end_time = 0.0;
};

}  // namespace

SweepCost predicted_cost(const std::vector<SweepRun>& runs) {
  std::map<std::string, std::optional<CostedPlan>> costs;  // none where the prediction fails
  SweepCost result{std::vector<double>(runs.size(), 0.0)};
  std::vector<std::size_t> unknown;
  double total = 0.0, n_known = 0.0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].scene || !(runs[i].scene->numerics.end_time > 0.0)) continue;
    const Scene& scene = *runs[i].scene;
    const RunPlan plan = plan_of(scene);
    const std::string name = cost_class(scene, plan);
    if (!costs.contains(name)) {
      RunPlan costed = plan;
      predict_cost(scene, costed);
      if (costed.stops.empty() && costed.unknown.empty()) {
        costs[name] = CostedPlan{costed, scene.numerics.end_time};
      } else {
        costs[name] = std::nullopt;
      }
    }
    if (!costs.at(name)) {
      unknown.push_back(i);
      continue;
    }
    const CostedPlan& cost = *costs.at(name);
    const double steps = scene.numerics.tolerance
                             ? static_cast<double>(cost.plan.n_steps) / cost.end_time * scene.numerics.end_time
                             : static_cast<double>(plan.n_steps);
    result.seconds[i] = steps * cost.plan.seconds_per_step;
    result.memory_bytes = std::max(result.memory_bytes, cost.plan.memory_bytes);
    total += result.seconds[i];
    n_known += 1.0;
  }
  for (const std::size_t i : unknown) result.seconds[i] = n_known > 0.0 ? total / n_known : 1.0;
  return result;
}

}  // namespace vehd
