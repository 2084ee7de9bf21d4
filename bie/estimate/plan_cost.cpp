#include "bie/estimate/plan_cost.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bie/runs/run_loop.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/memory.hpp"
#include "bie/support/output_error.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
namespace {

struct TimedSteps {
  double seconds_per_step = 0.0;  ///< of all steps but the first two
  std::string stops;              ///< why it did not come to its end; empty if it did
};

/// A real run of so many steps and two before them, files and all, in a folder that is gone afterwards.
TimedSteps timed_steps(Scene scene, int n_timed) {
  constexpr std::size_t kWarmUp = 2;
  scene.numerics.end_time = static_cast<double>(kWarmUp + n_timed) * *scene.numerics.dt;
  const TemporaryFolder folder("vehd-plan");
  const RunPaths paths{folder.path()};
  Interruption interruption;
  std::vector<std::chrono::steady_clock::time_point> ends;
  const auto note_end = [&ends] { ends.push_back(std::chrono::steady_clock::now()); };
  RunOutcome outcome;
  try {
    outcome = simulate({scene, paths, std::nullopt, {}, note_end, {}, longest_lag_of_files}, interruption);
  } catch (const ConvergenceError& error) {
    outcome = {.completed = false, .reason = error.what(), .cannot_step = true};
  }
  if (interruption.requested()) throw Interrupted("stopped by a signal");
  if (!outcome.completed && !outcome.cannot_step) throw OutputError(outcome.reason);
  if (outcome.cannot_step || ends.size() <= kWarmUp) return {0.0, outcome.reason};
  const std::chrono::duration<double> timed = ends.back() - ends[kWarmUp - 1];
  return {timed.count() / static_cast<double>(ends.size() - kWarmUp), {}};
}

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
  if (!plan.stops.empty()) return;
  plan.n_steps = row.steps;
  plan.seconds_per_step = row.steps > 0 ? row.seconds / static_cast<double>(row.steps) : 0.0;
  plan.memory_bytes = row.memory_bytes;
}

}  // namespace

void predict_cost(const Scene& scene, RunPlan& plan, CostCache& cache, const CostBudget& budget) {
  if (scene.numerics.tolerance) return predict_from_looser_runs(scene, plan, cache, budget);
  constexpr int kLargestTimed = 32;
  constexpr int kFewSteps = 3, kManySteps = 16;
  constexpr double kSlowStep = 0.3;
  Scene timed = scene;
  timed.numerics.order = std::min(scene.numerics.order, kLargestTimed);
  TimedSteps trial = timed_steps(timed, kFewSteps);
  if (trial.stops.empty() && trial.seconds_per_step < kSlowStep) trial = timed_steps(timed, kManySteps);
  plan.stops = trial.stops;
  if (!plan.stops.empty()) return;
  const double ratio = double(scene.numerics.order) / timed.numerics.order;
  plan.seconds_per_step = trial.seconds_per_step * std::pow(ratio, 5);
  plan.memory_bytes = static_cast<std::int64_t>(static_cast<double>(peak_memory_bytes()) * std::pow(ratio, 4));
}

}  // namespace vehd
