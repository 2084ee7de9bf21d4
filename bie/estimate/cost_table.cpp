#include "bie/estimate/cost_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/estimate/cost_model.hpp"
#include "bie/estimate/file_cost.hpp"
#include "bie/estimate/prediction.hpp"
#include "bie/estimate/stretch.hpp"
#include "bie/estimate/trial_run.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/support/deadline.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/memory.hpp"

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

/// What is left of a budget.
class BudgetLeft {
 public:
  /// Where steps are counted there is no deadline.
  explicit BudgetLeft(const CostBudget& budget)
      : budget_(budget), deadline_(budget.steps ? std::numeric_limits<double>::infinity() : budget.seconds) {}

  [[nodiscard]] Deadline& deadline() { return deadline_; }
  /// The cost model comes after it.
  [[nodiscard]] TrialBudget of_first_trial() {
    if (budget_.steps) return of_trial();
    return {.seconds = std::max(seconds_of_trials() - budget_.model_seconds, budget_.first_trial),
            .deadline = &deadline_};
  }
  [[nodiscard]] TrialBudget of_trial() {
    if (budget_.steps) return {.steps = steps_of_trials()};
    return {.seconds = seconds_of_trials(), .deadline = &deadline_};
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
  /// How many stretches there is time for.
  [[nodiscard]] std::size_t stretches(double seconds_of_each) const {
    constexpr double kMost = 12.0;
    const double n = budget_.steps ? double(steps()) / steps_of_stretch : seconds() / seconds_of_each;
    return static_cast<std::size_t>(std::clamp(n, 0.0, kMost));
  }
  void take(std::size_t steps) { taken_ += static_cast<std::int64_t>(steps); }

 private:
  [[nodiscard]] std::int64_t steps() const { return *budget_.steps - taken_; }
  [[nodiscard]] double seconds() const { return deadline_.seconds_left(); }
  [[nodiscard]] std::int64_t steps_of_trials() const {
    return steps() - std::llround(budget_.stretch_share * static_cast<double>(*budget_.steps));
  }
  [[nodiscard]] double seconds_of_trials() const { return seconds() - budget_.stretch_share * budget_.seconds; }

  CostBudget budget_;
  Deadline deadline_;
  std::int64_t taken_ = 0;
};

/// How many stretches there is time for at the tolerance of that index; none where these would be too few to tell.
std::size_t stretches_in_budget(const Knowledge& known, std::size_t index, const BudgetLeft& left) {
  constexpr std::size_t kFewest = 2;
  const std::size_t count = left.stretches(stretch_seconds(known, index));
  return count >= kFewest ? count : 0;
}

/// Finds out what a run with the tolerance of that index begins with, and takes stretches with it where none were taken
/// before. Tighter tolerances are better predicted from these than from their own, which are fewer and farther from the
/// trial run.
void sample(const Scene& scene, std::size_t index, Knowledge& known, BudgetLeft& left) {
  const double tolerance = known.tolerances[index];
  known.expect_start(tolerance);
  if (left.has_for_start(start_seconds(known, index))) {
    try {
      known.learn_start(tolerance, starting_order(scene, tolerance, &left.deadline()));
      left.take(1);
    } catch (const ConvergenceError&) {
      // Then looser tolerances have to tell.
    } catch (const OutOfTime&) {
      // Likewise.
    }
  }
  if (!known.stretches.empty()) return;
  const std::size_t count = stretches_in_budget(known, index, left);
  if (count == 0) return;
  const auto begins = [&left] {
    const bool any = left.any();
    if (any) left.take(steps_of_stretch);
    return any;
  };
  std::vector<Stretch> stretches =
      take_stretches(scene, known.trial, tolerance, count, predicted_orders(known, index), begins, &left.deadline());
  if (stretches.size() > 1) known.learn(tolerance, std::move(stretches));
}

/// Rows from the loosest tolerance to the tightest: of runs as long as the budget allows, then predicted.
class CostTable {
 public:
  CostTable(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache, const CostBudget& budget)
      : scene_(scene), tolerances_(tolerances), cache_(cache), budget_(budget), left_(budget) {}

  std::vector<CostRow> rows() {
    bool running = true;
    for (std::size_t i = 0; i < tolerances_.size(); ++i) {
      if (running && i > 0) running = known_ ? left_.may_do(predicted_row(*known_, i)) : left_.any_for_trials();
      CostRow row{.tolerance = tolerances_[i]};
      if (running) running = run(i, row);
      if (!running) predict(i, row);
      rows_.push_back(std::move(row));
    }
    for (CostRow& row : rows_) {
      if (!row.stops.empty() || !row.unknown.empty()) continue;
      row.file_seconds = file_seconds(scene_, row.steps, default_order(row.tolerance));
      row.seconds += row.file_seconds;
    }
    return std::move(rows_);
  }

 private:
  /// @return whether the run has ended by itself
  bool run(std::size_t i, CostRow& row) {
    TrialRun trial = run_trial(scene_, row.tolerance, tolerances_, i > 0 ? left_.of_trial() : left_.of_first_trial());
    left_.take(trial.steps.size());
    if (!trial.stops.empty()) {
      // What stops at one tolerance may well go on at the next, and says nothing of its cost.
      row.stops = trial.stops;
      known_.reset();
      reason_ = fmt::format("a run with the tolerance {:g} stops: {}", row.tolerance, trial.stops);
      return true;
    }
    if (trial.completed) {
      row.measured = true;
      row.seconds = trial.seconds;
      row.steps = static_cast<std::int64_t>(trial.steps.size());
      row.order = trial.highest_order;
      row.memory_bytes = peak_memory_bytes();
    }
    const bool completed = trial.completed;
    if (i + 1 < tolerances_.size() || !completed) learn(std::move(trial));
    return completed;
  }

  void learn(TrialRun trial) {
    if (trial.steps.empty()) {
      if (!trial.completed) reason_ = "the time was over before a first step ended";
      return;
    }
    if (known_) {
      if (!trial.completed) return;
      const auto first = std::ranges::find_if(rows_, [](const CostRow& row) { return row.stops.empty(); });
      known_->trend = trend_of(*first, known_->trial, trial);
    } else if (!make_model()) {
      return;
    }
    known_->learn(std::move(trial));
  }

  /// @return whether steps can be predicted
  bool make_model() {
    if (has_no_model_) return false;
    try {
      known_.emplace(
          Knowledge{scene_, tolerances_, cost_model_of(scene_, budget_.model_seconds, cache_, left_.deadline())});
    } catch (const ConvergenceError& error) {
      reason_ = error.what();
    } catch (const OutOfTime& error) {
      reason_ = error.what();
    }
    has_no_model_ = !known_;
    return !has_no_model_;
  }

  void predict(std::size_t i, CostRow& row) {
    if (!known_) {
      row.unknown = reason_;
      return;
    }
    sample(scene_, i, *known_, left_);
    row = predicted_row(*known_, i);
    row.memory_bytes = static_cast<std::int64_t>(known_->model.bytes(row.order));
    if (i == 0) return;
    // A tighter tolerance is never cheaper.
    const CostRow& looser = rows_.back();
    row.order = std::max(row.order, looser.order);
    row.steps = std::max(row.steps, looser.steps);
    row.seconds = std::max(row.seconds, looser.seconds);
    row.memory_bytes = std::max(row.memory_bytes, looser.memory_bytes);
  }

  const Scene& scene_;
  const std::vector<double>& tolerances_;
  CostCache& cache_;
  CostBudget budget_;
  BudgetLeft left_;
  std::optional<Knowledge> known_;  ///< of the last run that took steps
  bool has_no_model_ = false;
  std::string reason_ = "there was no time for a run";  ///< why nothing is known
  std::vector<CostRow> rows_;
};

}  // namespace

std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances, CostCache& cache,
                                   const CostBudget& budget) {
  const std::string identity = identity_of(scene, tolerances, budget);
  if (const auto entry = cache.find(cost_table_entry, identity)) {
    if (std::vector<CostRow> rows = rows_of(*entry, tolerances.size()); !rows.empty()) return rows;
  }
  std::vector<CostRow> rows = CostTable(scene, tolerances, cache, budget).rows();
  const bool is_known = std::ranges::all_of(rows, [](const CostRow& row) { return row.unknown.empty(); });
  if (is_known) cache.keep(cost_table_entry, identity, json_of(rows));
  return rows;
}

}  // namespace vehd
