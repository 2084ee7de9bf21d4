#include "bie/estimate/cost_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "bie/estimate/cost_model.hpp"
#include "bie/estimate/trial_run.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/thresholds.hpp"
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

/// Seconds that the model gives to the steps that a trial run took.
double model_seconds(const TrialRun& trial, const CostModel& model) {
  double seconds = 0.0;
  for (const TrialStep& step : trial.steps) {
    seconds += step.evaluations * model.seconds_per_shape(step.order);
  }
  return seconds;
}

/// What trial runs tell of tighter tolerances beside the steps of the last of them.
struct Trend {
  int degrees_per_digit = 4;    ///< that runs take, at most
  std::optional<double> order;  ///< in dt, at the steps of the trial runs; nothing: that of the scheme
};

/// How many steps with that tolerance take the place of one of a trial run.
double steps_for_one(const TrialStep& step, const TrialRun& trial, double tolerance, const Trend& trend) {
  constexpr double kLongest = 4.0;  // beyond that an error estimate says nothing any more
  const int time_order = accuracy_defaults(tolerance).time_order;
  if (trend.order) {
    // Stiff motions follow their steps with a lower order than that of the scheme.
    return std::pow(trial.tolerance / tolerance, 1.0 / (*trend.order + time_order - trial.time_order));
  }
  const double room =
      step.error_estimate > 0.0 ? std::pow(tolerance / step.error_estimate, 1.0 / time_order) : kLongest;
  return 1.0 / (thresholds::step_safety * std::min(room, kLongest));
}

/// The cost table's row for the tolerance of that index, from the steps of a trial run with a looser one.
CostRow predicted_row(const Scene& scene, const TrialRun& trial, const std::vector<double>& tolerances,
                      std::size_t index, const CostModel& model, const Trend& trend) {
  CostRow row;
  row.tolerance = tolerances[index];
  const double largest = step_control_of(at_tolerance(scene, row.tolerance)).largest;
  const double digits = std::log10(trial.tolerance / row.tolerance);
  const int highest = std::min(trial.highest_order + static_cast<int>(std::lround(digits * trend.degrees_per_digit)),
                               accuracy_defaults(row.tolerance).order);
  const auto own = static_cast<std::size_t>(std::ranges::find(tolerances, trial.tolerance) - tolerances.begin());
  int order = 0, trial_order = 0;
  double steps = 0.0, seconds = 0.0;
  for (const TrialStep& step : trial.steps) {
    const double share = std::max(steps_for_one(step, trial, row.tolerance, trend), step.dt / largest);
    // Runs lower their degree only where it has long been idle, at other tolerances about where the trial run did.
    if (step.order < trial_order) order = 0;
    trial_order = step.order;
    // Growth that is expected asks for more than the spectrum does.
    const int of_growth = std::max(0, step.order - step.orders[own]);
    order = std::max({order, step.order, std::min(step.orders[index] + of_growth, highest)});
    steps += share;
    // Snapshots cost an evaluation each, however many steps there are.
    seconds += (share * (step.evaluations - step.moments) + step.moments) * model.seconds_per_shape(order);
    row.order = std::max(row.order, order);
  }
  const double covered = trial.steps.empty() ? 1.0 : trial.steps.back().time / scene.numerics.end_time;
  row.steps = std::llround(std::ceil(steps / covered));
  row.seconds = seconds / covered;
  return row;
}

/// Files of a run beside its steps: each snapshot is written in the highest degree. Measured once, 2.5 ms a snapshot at
/// p = 16 and 6.5 ms at p = 40: a small share of any run.
double file_seconds(const Scene& scene, const CostRow& row) {
  constexpr double kPerRow = 2e-4, kPerSnapshot = 2e-3, kPerPoint = 1.4e-6;
  const double snapshots = 2.0 + events_of(scene).snapshots.count(scene.numerics.end_time);
  const double order = accuracy_defaults(row.tolerance).order;
  return kPerRow * static_cast<double>(row.steps) + snapshots * (kPerSnapshot + kPerPoint * 2.0 * order * order);
}

/// Degrees that a trial run needed more than the first of all, for every digit between them. The tail of a spectrum
/// that is cut falls more slowly than the degrees beyond it, so what it predicts for many digits is too much.
int degrees_per_digit(const CostRow& first, const TrialRun& trial) {
  constexpr double kLeast = 4.0;
  const double more = trial.highest_order - first.order;
  return static_cast<int>(std::ceil(std::max(kLeast, more / std::log10(first.tolerance / trial.tolerance))));
}

/// Order in dt of two trial runs of one time order, as their steps tell: k where each digit takes 10^(1/k) times as
/// many.
std::optional<double> order_between(const TrialRun& trial, const TrialRun& next) {
  constexpr double kLeastRatio = 1.3;
  const double more = static_cast<double>(next.steps.size()) / static_cast<double>(trial.steps.size());
  if (trial.time_order != next.time_order || more < kLeastRatio) return std::nullopt;
  return std::clamp(std::log(trial.tolerance / next.tolerance) / std::log(more), 1.0,
                    static_cast<double>(next.time_order));
}

/// Rows without any cost.
std::vector<CostRow> stopping_rows(const std::vector<double>& tolerances, const std::string& reason) {
  std::vector<CostRow> rows;
  for (const double tolerance : tolerances) rows.push_back({.tolerance = tolerance, .stops = reason});
  return rows;
}

/// What is left of a budget for trial runs.
class BudgetLeft {
 public:
  explicit BudgetLeft(const CostBudget& budget) : budget_(budget) {}

  [[nodiscard]] TrialBudget of_first_trial() const {
    if (budget_.steps) return of_trial();
    return {.seconds = std::max(seconds(), budget_.first_trial)};
  }
  [[nodiscard]] TrialBudget of_trial() const {
    if (budget_.steps) return {.steps = steps()};
    return {.seconds = seconds()};
  }
  [[nodiscard]] bool any() const { return budget_.steps ? steps() > 0 : seconds() > 0.0; }
  /// Whether a trial run for which that was predicted may well reach its end: it often takes less than what one with a
  /// tenth of the accuracy predicts.
  [[nodiscard]] bool may_do(const CostRow& predicted) const {
    constexpr double kUncertainty = 3.0;
    return budget_.steps ? double(predicted.steps) < kUncertainty * double(steps())
                         : predicted.seconds < kUncertainty * seconds();
  }
  void take(const TrialRun& trial) { taken_ += std::ssize(trial.steps); }

 private:
  [[nodiscard]] std::int64_t steps() const { return *budget_.steps - taken_; }
  [[nodiscard]] double seconds() const {
    return budget_.seconds - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  CostBudget budget_;
  std::int64_t taken_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

std::vector<CostRow> measured_table(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                    const CostBudget& budget) {
  BudgetLeft left(budget);
  const CostModel model = cost_model_of(scene, budget.model_seconds, cache);
  std::vector<CostRow> rows;
  TrialRun trial;
  double ratio = 1.0;  // of this scene to others of its kind
  Trend trend;
  bool running = true;
  for (std::size_t i = 0; i < tolerances.size(); ++i) {
    // What stops at one tolerance may well go on at the next, and says nothing of its cost.
    const bool predicts = trial.stops.empty() && !trial.steps.empty();
    if (running && predicts) {
      CostRow predicted = predicted_row(scene, trial, tolerances, i, model, trend);
      predicted.seconds *= ratio;
      running = left.may_do(predicted);
    } else if (running && i > 0) {
      running = left.any();
    }
    if (running) {
      TrialRun next = run_trial(scene, tolerances[i], tolerances, i > 0 ? left.of_trial() : left.of_first_trial());
      left.take(next);
      running = next.completed || !next.stops.empty();
      if (predicts && next.completed) {
        const auto first = std::ranges::find_if(rows, [](const CostRow& row) { return row.stops.empty(); });
        trend = {degrees_per_digit(*first, next), order_between(trial, next)};
      }
      if (!predicts || next.completed || !next.stops.empty()) trial = std::move(next);
      if (const double expected = model_seconds(trial, model); expected > 0.0) ratio = trial.seconds / expected;
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
      row = predicted_row(scene, trial, tolerances, i, model, trend);
      row.seconds *= ratio;
      // A tighter tolerance is never cheaper.
      if (i > 0) {
        row.order = std::max(row.order, rows.back().order);
        row.steps = std::max(row.steps, rows.back().steps);
        row.seconds = std::max(row.seconds, rows.back().seconds);
      }
    }
    row.memory_bytes = static_cast<std::int64_t>(model.bytes(row.order));
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
