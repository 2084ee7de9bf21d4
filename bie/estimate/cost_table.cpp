#include "bie/estimate/cost_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>

#include "bie/estimate/cost_model.hpp"
#include "bie/estimate/prediction.hpp"
#include "bie/estimate/stretch.hpp"
#include "bie/estimate/trial_run.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr const char* cost_table_entry = "cost table";

/// What decides the cost table: every key of the scene but those that a tolerance decides, the shape that it may read,
/// and steps of trial runs where they are counted.
std::string identity_of(const Scene& scene, const std::vector<double>& tolerances, const CostBudget& budget) {
  std::string text = effective_scene(at_tolerance(scene, tolerances.front()));
  for (const double tolerance : tolerances) text += fmt::format("# {:g}\n", tolerance);
  if (budget.steps) text += fmt::format("# {} steps\n", *budget.steps);
  if (scene.shape.path.empty()) return text;
  std::error_code ignored;
  const auto written = std::filesystem::last_write_time(scene.shape.path, ignored).time_since_epoch().count();
  return text + fmt::format("# {} bytes, {}\n", std::filesystem::file_size(scene.shape.path, ignored), written);
}

nlohmann::json json_of(const std::vector<CostRow>& rows) {
  nlohmann::json json = nlohmann::json::array();
  for (const CostRow& row : rows) {
    json.push_back({row.tolerance, row.order, row.steps, row.seconds, row.file_seconds, row.memory_bytes, row.measured,
                    row.stops});
  }
  return json;
}

/// Empty where the entry is not what is expected.
std::vector<CostRow> rows_of(const nlohmann::json& entry, std::size_t count) {
  std::vector<CostRow> rows;
  try {
    for (const auto& row : entry) {
      rows.push_back({row.at(0), row.at(1), row.at(2), row.at(3), row.at(4), row.at(5), row.at(6), row.at(7)});
    }
  } catch (const nlohmann::json::exception&) {
    return {};
  }
  return rows.size() == count ? rows : std::vector<CostRow>();
}

/// Files of a run beside its steps: each snapshot is written in the highest degree. Measured once, 2.5 ms a snapshot at
/// p = 16 and 6.5 ms at p = 40: a small share of any run.
double file_seconds(const Scene& scene, const CostRow& row) {
  constexpr double kPerRow = 2e-4, kPerSnapshot = 2e-3, kPerPoint = 1.4e-6;
  const double snapshots = 2.0 + events_of(scene).snapshots.count(scene.numerics.end_time);
  const double order = accuracy_defaults(row.tolerance).order;
  return kPerRow * static_cast<double>(row.steps) + snapshots * (kPerSnapshot + kPerPoint * 2.0 * order * order);
}

/// Rows without any cost.
std::vector<CostRow> stopping_rows(const std::vector<double>& tolerances, const std::string& reason) {
  std::vector<CostRow> rows;
  for (const double tolerance : tolerances) rows.push_back({.tolerance = tolerance, .stops = reason});
  return rows;
}

/// What is left of a budget.
class BudgetLeft {
 public:
  explicit BudgetLeft(const CostBudget& budget) : budget_(budget) {}

  [[nodiscard]] TrialBudget of_first_trial() const {
    if (budget_.steps) return of_trial();
    return {.seconds = std::max(seconds_of_trials(), budget_.first_trial)};
  }
  [[nodiscard]] TrialBudget of_trial() const {
    if (budget_.steps) return {.steps = steps_of_trials()};
    return {.seconds = seconds_of_trials()};
  }
  [[nodiscard]] bool any_for_trials() const {
    return budget_.steps ? steps_of_trials() > 0 : seconds_of_trials() > 0.0;
  }
  /// Whether a trial run for which that was predicted should reach its end. One that does not has taken the time of
  /// stretches, which tell nearly as much.
  [[nodiscard]] bool may_do(const CostRow& predicted) const {
    constexpr double kUncertainty = 1.25;
    return budget_.steps ? double(predicted.steps) < kUncertainty * double(steps_of_trials())
                         : predicted.seconds < kUncertainty * seconds_of_trials();
  }
  [[nodiscard]] bool any() const { return budget_.steps ? steps() > 0 : seconds() > 0.0; }
  /// Whether there is time for the start of a run, and far more left for the rest of it.
  [[nodiscard]] bool has_for_start(double seconds_of_start) const {
    constexpr double kShare = 0.2;
    return budget_.steps ? steps() > 0 : seconds_of_start < kShare * seconds();
  }
  /// How many stretches there is time for at each of some tolerances.
  /// @param seconds_of_each  of one stretch with each of them
  [[nodiscard]] std::size_t stretches(const std::vector<double>& seconds_of_each) const {
    constexpr double kMost = 12.0;
    const double of_all = std::accumulate(seconds_of_each.begin(), seconds_of_each.end(), 0.0);
    const double n =
        budget_.steps ? double(steps()) / (steps_of_stretch * double(seconds_of_each.size())) : seconds() / of_all;
    return static_cast<std::size_t>(std::clamp(n, 0.0, kMost));
  }
  void take(std::size_t steps) { taken_ += static_cast<std::int64_t>(steps); }

 private:
  [[nodiscard]] std::int64_t steps() const { return *budget_.steps - taken_; }
  [[nodiscard]] double seconds() const {
    return budget_.seconds - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  [[nodiscard]] std::int64_t steps_of_trials() const {
    return steps() - std::llround(budget_.stretch_share * static_cast<double>(*budget_.steps));
  }
  [[nodiscard]] double seconds_of_trials() const { return seconds() - budget_.stretch_share * budget_.seconds; }

  CostBudget budget_;
  std::int64_t taken_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int time_order_of(double tolerance) { return accuracy_defaults(tolerance).time_order; }

/// How many stretches there is time for if tolerances from that index to the first of the highest time order are to
/// have as many; if that is none, the fewest that tell anything where this one alone may have them.
std::size_t stretches_in_budget(const Knowledge& known, std::size_t index, const BudgetLeft& left) {
  constexpr std::size_t kFewest = 2;
  std::vector<double> seconds;
  for (std::size_t i = index; i < known.tolerances.size(); ++i) {
    seconds.push_back(stretch_seconds(known, i));
    if (time_order_of(known.tolerances[i]) == highest_time_order) break;
  }
  const std::size_t shared = left.stretches(seconds);
  if (shared >= kFewest) return shared;
  return left.stretches({seconds.front()}) >= kFewest ? kFewest : 0;
}

/// Finds out what a run with the tolerance of that index begins with, and takes stretches with it. Tighter tolerances
/// than one of the highest time order are better predicted from its stretches than from their own, which are fewer and
/// farther from the trial run.
void sample(const Scene& scene, std::size_t index, Knowledge& known, BudgetLeft& left) {
  const double tolerance = known.tolerances[index];
  known.expect_start(tolerance);
  if (left.has_for_start(start_seconds(known, index))) {
    try {
      known.learn_start(tolerance, starting_order(scene, tolerance));
      left.take(1);
    } catch (const ConvergenceError&) {
      // Then looser tolerances have to tell.
    }
  }
  if (!known.stretches.empty() && time_order_of(known.sampled) == highest_time_order) return;
  const std::size_t count = stretches_in_budget(known, index, left);
  if (count == 0) return;
  const auto begins = [&left] {
    const bool any = left.any();
    if (any) left.take(steps_of_stretch);
    return any;
  };
  std::vector<Stretch> stretches =
      take_stretches(scene, known.trial, tolerance, count, predicted_orders(known, index), begins);
  if (stretches.size() > 1) known.learn(tolerance, std::move(stretches));
}

std::vector<CostRow> measured_table(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                    const CostBudget& budget) {
  BudgetLeft left(budget);
  Knowledge known{scene, tolerances, cost_model_of(scene, budget.model_seconds, cache)};
  TrialRun& trial = known.trial;
  std::vector<CostRow> rows;
  bool running = true;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    // What stops at one tolerance may well go on at the next, and says nothing of its cost.
    const bool predicts = trial.stops.empty() && !trial.steps.empty();
    if (running && predicts) {
      running = left.may_do(predicted_row(known, i));
    } else if (running && i > 0) {
      running = left.any_for_trials();
    }
    if (running) {
      TrialRun next = run_trial(scene, tolerances[i], tolerances, i > 0 ? left.of_trial() : left.of_first_trial());
      left.take(next.steps.size());
      running = next.completed || !next.stops.empty();
      if (predicts && next.completed) {
        const auto first = std::ranges::find_if(rows, [](const CostRow& row) { return row.stops.empty(); });
        known.trend = trend_of(*first, trial, next);
      }
      if (!predicts || next.completed || !next.stops.empty()) known.learn(std::move(next));
    }
    CostRow row;
    row.tolerance = tolerances[i];
    row.stops = trial.stops;
    if (!row.stops.empty()) {
      rows.push_back(row);
      continue;
    }
    if (running) {
      row.measured = true;
      row.seconds = trial.seconds;
      row.steps = static_cast<std::int64_t>(trial.steps.size());
      row.order = trial.highest_order;
    } else {
      sample(scene, i, known, left);
      row = predicted_row(known, i);
      // A tighter tolerance is never cheaper.
      if (i > 0) {
        row.order = std::max(row.order, rows.back().order);
        row.steps = std::max(row.steps, rows.back().steps);
        row.seconds = std::max(row.seconds, rows.back().seconds);
      }
    }
    row.memory_bytes = static_cast<std::int64_t>(known.model.bytes(row.order));
    rows.push_back(row);
  }
  for (CostRow& row : rows) {
    if (!row.stops.empty()) continue;
    row.file_seconds = file_seconds(scene, row);
    row.seconds += row.file_seconds;
  }
  return rows;
}

/// The same, or rows that say why no step could be timed.
std::vector<CostRow> table_or_reason(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                     const CostBudget& budget) {
  try {
    return measured_table(scene, tolerances, cache, budget);
  } catch (const ConvergenceError& error) {
    return stopping_rows(tolerances, error.what());
  }
}

}  // namespace

std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                   const CostBudget& budget) {
  const std::string identity = identity_of(scene, tolerances, budget);
  if (const auto entry = cache.find(cost_table_entry, identity)) {
    if (std::vector<CostRow> rows = rows_of(*entry, tolerances.size()); !rows.empty()) return rows;
  }
  std::vector<CostRow> rows = table_or_reason(scene, tolerances, cache, budget);
  cache.keep(cost_table_entry, identity, json_of(rows));
  return rows;
}

}  // namespace vehd
