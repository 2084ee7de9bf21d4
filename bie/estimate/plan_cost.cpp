#include "bie/estimate/plan_cost.hpp"

#include <utility>

#include "bie/estimate/cost_model.hpp"
#include "bie/estimate/file_cost.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/support/deadline.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

/// A tolerance finds its own steps and degrees, so runs with looser ones have to tell.
void predict_from_looser_runs(const Scene& scene, RunPlan& plan, CostCache& cache, const CostBudget& budget) {
  constexpr double kLoosest = 0.1;
  std::vector<double> tolerances;
  for (double tolerance = kLoosest; tolerance > 1.001 * *scene.numerics.tolerance; tolerance /= 10.0) {
    tolerances.push_back(tolerance);
  }
  tolerances.push_back(*scene.numerics.tolerance);
  const CostRow row = cost_table_of(scene, tolerances, cache, budget).back();
  plan.stops = row.stops;
  plan.unknown = row.unknown;
  if (!plan.stops.empty() || !plan.unknown.empty()) return;
  plan.n_steps = row.steps;
  plan.seconds_per_step = row.steps > 0 ? row.seconds / static_cast<double>(row.steps) : 0.0;
  plan.memory_bytes = row.memory_bytes;
}

/// Lower degrees first: they tell whether there is time for that of the scene.
void predict_from_own_steps(const Scene& scene, RunPlan& plan, const CostBudget& budget) {
  constexpr int kMostSteps = 18;
  constexpr double kShare = 0.3;  // of the budget, for steps of the scene's own degree
  Deadline deadline(budget.seconds);
  std::vector<CostModel::Point> points;
  TimedSteps last;
  const int last_order = time_rising_degrees(scene.numerics.order, budget.seconds, [&](int order) {
    const bool is_own = order == scene.numerics.order;
    Scene timed = scene;
    timed.numerics.order = order;
    last = timed_steps(timed, is_own ? kMostSteps : 1, kShare * budget.seconds, deadline);
    if (last.point) points.push_back(*last.point);
  });
  const bool is_own = last_order == scene.numerics.order;
  if (is_own && !last.stops.empty()) {
    plan.stops = last.stops;
    return;
  }
  plan.memory_bytes = peak_memory_bytes();
  if (plan.n_steps == 0) return;
  if (points.empty()) {
    plan.unknown = "the time was over before a first step ended";
    return;
  }
  const CostModel model(std::move(points));
  const double files = file_seconds(scene, plan.n_steps, scene.numerics.order) / static_cast<double>(plan.n_steps);
  plan.seconds_per_step =
      files + evaluations_per_step(scene.numerics.time_order) * model.seconds_per_shape(scene.numerics.order);
  if (!is_own) plan.memory_bytes = static_cast<std::int64_t>(model.bytes(scene.numerics.order));
}

}  // namespace

void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const CostBudget& budget) {
  if (scene.numerics.tolerance) return predict_from_looser_runs(scene, plan, cache, budget);
  predict_from_own_steps(scene, plan, budget);
}

}  // namespace vehd
