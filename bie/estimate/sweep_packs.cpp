#include "bie/estimate/sweep_packs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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
  std::map<std::string, CostedPlan> costs;
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
      if (!costed.stops.empty() || !costed.unknown.empty()) {
        unknown.push_back(i);
        continue;
      }
      costs[name] = {costed, scene.numerics.end_time};
    }
    const CostedPlan& cost = costs.at(name);
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

std::vector<SweepPack> packs_of(const std::vector<double>& seconds, std::size_t n_packs) {
  std::vector<std::size_t> longest_first(seconds.size());
  std::iota(longest_first.begin(), longest_first.end(), std::size_t{0});
  std::stable_sort(longest_first.begin(), longest_first.end(),
                   [&](std::size_t a, std::size_t b) { return seconds[a] > seconds[b]; });
  std::vector<SweepPack> packs(std::max<std::size_t>(n_packs, 1));
  std::vector<double> load(packs.size(), 0.0);
  for (const std::size_t run : longest_first) {
    const auto least = static_cast<std::size_t>(std::min_element(load.begin(), load.end()) - load.begin());
    packs[least].push_back(run);
    load[least] += seconds[run];
  }
  std::erase_if(packs, [](const SweepPack& pack) { return pack.empty(); });
  return packs;
}

std::size_t packs_within(const std::vector<double>& seconds, double limit_seconds) {
  constexpr double room = 1.5;
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const auto wanted = std::ceil(room * total / limit_seconds);
  const auto most = static_cast<double>(std::max<std::size_t>(seconds.size(), 1));
  return static_cast<std::size_t>(std::clamp(wanted, 1.0, most));
}

}  // namespace vehd
