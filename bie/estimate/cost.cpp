#include "bie/estimate/cost.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

/// The time limit of some work has passed.
class OutOfTime : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Time limit of some work: once it has passed, observed instruments throw OutOfTime when the next part begins.
class Deadline : public PartObserver {
 public:
  /// @param seconds  from now
  explicit Deadline(double seconds) : seconds_(seconds) {}

  /// Negative once the limit has passed.
  [[nodiscard]] double seconds_left() const {
    return seconds_ - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void begin(const std::string& part) override {
    if (!(seconds_left() > 0.0)) throw OutOfTime("no time is left for: " + part);
  }
  void end() override {}

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

using Clock = std::chrono::steady_clock;

constexpr const char* out_of_time = "the time was over before a first step ended";

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::int64_t rounded(double count) { return std::llround(std::min(count, 1e18)); }

/// Steps of a run without files, to the end of the scene or as far as the trial went.
struct TrialRun {
  std::vector<double> times;    ///< at the end of each step
  std::vector<double> seconds;  ///< duration of each step
  double all_seconds = 0.0;     ///< of the steps and of the start
  double evaluations = 0.0;     ///< of new shapes, by the steps
  double snapshots = 0.0;       ///< evaluations at snapshots within steps
  int order = 0;                ///< highest degree; 0: no time to evaluate the start
  bool completed = false;
  std::string stops{};  ///< why no further step could be taken

  [[nodiscard]] bool is_known() const { return completed || !times.empty(); }
  [[nodiscard]] double n_steps() const { return static_cast<double>(times.size()); }
  /// Steps of the whole run over steps taken, if the remaining steps are as long as those of the later half so far.
  [[nodiscard]] double whole(double end_time) const {
    if (completed) return 1.0;
    const std::size_t half = times.size() / 2;
    const double later = times.back() - (half > 0 ? times[half - 1] : 0.0);
    return 1.0 + (end_time - times.back()) / later * static_cast<double>(times.size() - half) / n_steps();
  }
};

/// Takes steps until the end of the scene, most_steps or the given seconds are reached, but at least one.
TrialRun run_trial(const Scene& scene, std::int64_t most_steps, double seconds, Deadline& deadline) {
  const EventTimes events = events_of(scene);
  TrialRun trial;
  try {
    const Problem problem = problem_of(scene);
    Instruments instruments(&deadline);
    const auto start = Clock::now();
    Evolution evolution(setup_of(problem), problem.start, instruments);
    const auto note = [&] {
      trial.order = std::max(trial.order, highest_order_of(evolution.state()));
      trial.completed = evolution.state().time >= events.end_time;
      return std::exchange(trial.all_seconds, seconds_since(start));
    };
    evolution.evaluate_start();
    note();
    while (!trial.completed && std::ssize(trial.times) < most_steps &&
           (trial.times.empty() || trial.all_seconds < seconds)) {
      const int evaluations = evolution.step(events).evaluations;
      const auto snapshots = static_cast<double>(evolution.dense_output().size());
      const double before = note();
      trial.times.push_back(evolution.state().time);
      trial.seconds.push_back(trial.all_seconds - before);
      trial.evaluations += evaluations - snapshots;
      trial.snapshots += snapshots;
    }
  } catch (const ConvergenceError& error) {
    trial.stops = error.what();
  } catch (const OutOfTime&) {
    // The steps taken so far are used.
  }
  return trial;
}

/// The scene at this tolerance; unchanged if it has it already.
Scene with_tolerance(const Scene& scene, double tolerance) {
  return scene.numerics.tolerance == tolerance ? scene : at_tolerance(scene, tolerance);
}

/// Cost of a step of one degree, timed or extrapolated.
struct StepCost {
  int order = 0;         ///< 0: unknown
  double seconds = 0.0;  ///< per step
  double bytes = 0.0;    ///< peak memory of the process
  double took = 0.0;     ///< spent on timing, in seconds
  std::string stops{};   ///< why a step could not be taken
};

/// Mean time of fixed steps from the start, without the first two if there are more; without steps, that of the start.
/// @param seconds  after which only the first step may begin
StepCost timed_steps(Scene scene, int order, double seconds, Deadline& deadline) {
  constexpr std::size_t kWarmUp = 2, kMost = 18;
  scene.numerics.order = order;
  const TrialRun run = run_trial(scene, kMost, seconds, deadline);
  if (!run.stops.empty() || !run.is_known()) return {.stops = run.stops};
  const std::span steps = std::span(run.seconds).subspan(run.seconds.size() > kWarmUp ? kWarmUp : 0);
  const double mean = std::reduce(steps.begin(), steps.end()) / static_cast<double>(steps.size());
  return {order, steps.empty() ? run.all_seconds : mean, static_cast<double>(peak_memory_bytes()), run.all_seconds};
}

/// Cost of a step: timed if that is expected to fit into the time left, otherwise from a lower degree by power laws.
/// Measured exponents: 3.5 for sheared shapes from degree 14 to 26, 2.9 for axisymmetric ones from 48 to 56.
/// @param seconds  as in timed_steps
StepCost step_cost(const Scene& scene, int order, const StepCost& lower, double seconds, Deadline& deadline) {
  constexpr double kSeconds = 3.5, kBytes = 4.0, kMostSeconds = 4.5;
  if (order <= lower.order) return lower;
  const double growth = lower.order > 0 ? static_cast<double>(order) / lower.order : 1.0;
  const double expected = lower.took * std::pow(growth, kMostSeconds);
  StepCost cost;
  if (expected < deadline.seconds_left()) cost = timed_steps(scene, order, seconds, deadline);
  if (cost.order == 0 && lower.order > 0) {
    cost = {order, lower.seconds * std::pow(growth, kSeconds), lower.bytes * std::pow(growth, kBytes), expected,
            cost.stops};
  }
  return cost;
}

/// A scene of twenty fixed steps of this size.
Scene with_fixed_steps(Scene scene, double dt) {
  scene.numerics.tolerance.reset();
  scene.numerics.dt = dt;
  scene.numerics.time_order = highest_time_order;
  scene.numerics.end_time = 20.0 * dt;
  scene.output = {};
  return scene;
}

/// Time spent on files; snapshots have the highest degree. Measured: 2.5 ms a snapshot at p = 16, 6.5 ms at p = 40.
double file_seconds(const Scene& scene, double steps, int order) {
  constexpr double kPerRow = 2e-4, kPerSnapshot = 2e-3, kPerPoint = 1.4e-6;
  const double snapshots = 2.0 + events_of(scene).snapshots.count(scene.numerics.end_time);
  return kPerRow * steps + snapshots * (kPerSnapshot + kPerPoint * 2.0 * order * order);
}

/// Rows for falling tolerances; the trial run has the first of them.
std::vector<CostRow> predicted_rows(const Scene& scene, std::span<const double> tolerances, const TrialRun& trial,
                                    Deadline& deadline) {
  constexpr double kTimedSeconds = 0.1;  // for each degree
  std::vector<CostRow> rows;
  if (!trial.is_known()) {
    for (const double tolerance : tolerances) rows.push_back({.tolerance = tolerance, .unknown = out_of_time});
    return rows;
  }
  const double whole = trial.whole(scene.numerics.end_time);
  // Growth of the cost with the degree; if no step can be timed at the first one, only power laws are used.
  StepCost cost{trial.order, 1.0, static_cast<double>(peak_memory_bytes()), std::numeric_limits<double>::infinity()};
  const Scene timed = with_fixed_steps(scene, trial.times.empty() ? 0.0 : trial.times.front());
  if (tolerances.size() > 1) {
    if (const StepCost first = timed_steps(timed, trial.order, kTimedSeconds, deadline); first.order > 0) cost = first;
  }
  const double per_evaluation = trial.all_seconds / (1.0 + trial.evaluations + trial.snapshots) / cost.seconds;
  // Measured in the shipped scenes: 2 to 5, or 4 to 8 if the trial run took the highest degree of its tolerance.
  const double degrees_per_digit = trial.order < with_tolerance(scene, tolerances.front()).numerics.order ? 4.0 : 6.0;
  for (const double tolerance : tolerances) {
    const double ratio = tolerances.front() / tolerance;
    const int more_degrees = static_cast<int>(std::lround(degrees_per_digit * std::log10(ratio)));
    const int highest = with_tolerance(scene, tolerance).numerics.order;
    const double more = whole * std::pow(ratio, 1.0 / highest_time_order);
    const double evaluations = 1.0 + trial.evaluations * more + trial.snapshots * whole;
    CostRow row{.tolerance = tolerance, .measured = trial.completed && rows.empty()};
    row.order = std::min(trial.order + more_degrees, highest);
    row.steps = rounded(std::ceil(trial.n_steps() * more));
    const double cheaper = cost.seconds;
    cost = step_cost(timed, row.order, cost, kTimedSeconds, deadline);
    cost.seconds = std::max(cost.seconds, cheaper);
    row.file_seconds = file_seconds(scene, trial.n_steps() * more, highest);
    row.seconds = row.file_seconds + evaluations * per_evaluation * cost.seconds;
    row.memory_bytes = rounded(cost.bytes);
    rows.push_back(row);
  }
  return rows;
}

void predict_from_fixed_steps(const Scene& scene, RunPlan& plan, const CostBudget& budget) {
  constexpr double kShare = 0.3;  // of the seconds, for steps of the scene's own degree
  const int own = scene.numerics.order;
  Deadline deadline(budget.seconds);
  StepCost cost;
  // Steps of lower degrees show whether there is time for a step of the scene's degree.
  for (const int order : {8, 12, 16, 24, 32, 48}) {
    if (order < own) cost = step_cost(scene, order, cost, 0.0, deadline);
  }
  cost = step_cost(scene, own, cost, kShare * budget.seconds, deadline);
  plan.stops = cost.stops;
  if (cost.order == 0 && plan.stops.empty()) plan.unknown = out_of_time;
  if (cost.order == 0 || !plan.stops.empty()) return;
  plan.memory_bytes = rounded(cost.bytes);
  if (plan.n_steps == 0) return;
  const auto steps = static_cast<double>(plan.n_steps);
  plan.seconds_per_step = cost.seconds + file_seconds(scene, steps, own) / steps;
}

}  // namespace

std::vector<CostRow> cost_table_of(const Scene& scene, const std::vector<double>& tolerances,
                                   const CostBudget& budget) {
  constexpr double kShareOfTiming = 0.4;  // of the seconds, kept for steps of higher degrees
  Deadline deadline(budget.seconds);
  std::vector<CostRow> rows;
  for (const double tolerance : tolerances) {
    const TrialRun trial = run_trial(with_tolerance(scene, tolerance), budget.steps,
                                     deadline.seconds_left() - kShareOfTiming * budget.seconds, deadline);
    if (trial.stops.empty()) {
      std::ranges::move(predicted_rows(scene, std::span(tolerances).subspan(rows.size()), trial, deadline),
                        std::back_inserter(rows));
      break;
    }
    // A tighter tolerance may still succeed.
    rows.push_back({.tolerance = tolerance, .stops = trial.stops});
  }
  return rows;
}

void predict_cost(const Scene& scene, RunPlan& plan, const CostBudget& budget) {
  if (!scene.numerics.tolerance) return predict_from_fixed_steps(scene, plan, budget);
  constexpr double kLoosest = 1e-2;
  std::vector<double> tolerances{*scene.numerics.tolerance};
  if (tolerances.front() < kLoosest) tolerances.insert(tolerances.begin(), kLoosest);
  const CostRow row = cost_table_of(scene, tolerances, budget).back();
  plan.stops = row.stops;
  plan.unknown = row.unknown;
  plan.n_steps = row.steps;
  plan.seconds_per_step = row.steps > 0 ? row.seconds / static_cast<double>(row.steps) : 0.0;
  plan.memory_bytes = row.memory_bytes;
}

}  // namespace vehd
