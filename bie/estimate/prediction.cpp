#include "bie/estimate/prediction.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/stepping/time/time_rule.hpp"

namespace vehd {
namespace {

/// Seconds that the model gives to steps.
double model_seconds(const std::vector<TrialStep>& steps, const CostModel& model) {
  double seconds = 0.0;
  for (const TrialStep& step : steps) seconds += step.evaluations * model.seconds_per_shape(step.order);
  return seconds;
}

/// Degrees that a trial run needed more than the first of all, for every digit between them. The tail of a spectrum
/// that is cut falls more slowly than the degrees beyond it, so what it predicts for many digits is too much.
int degrees_per_digit(const CostRow& first, const TrialRun& trial) {
  constexpr double kLeast = 4.0;
  const double more = trial.highest_order - first.order;
  return static_cast<int>(std::ceil(std::max(kLeast, more / std::log10(first.tolerance / trial.tolerance))));
}

/// Order in dt of two trial runs, as their steps tell: k where each digit takes 10^(1/k) times as many.
std::optional<double> order_between(const TrialRun& trial, const TrialRun& next) {
  constexpr double kLeastRatio = 1.3;
  const double more = static_cast<double>(next.steps.size()) / static_cast<double>(trial.steps.size());
  if (more < kLeastRatio) return std::nullopt;
  return std::clamp(std::log(trial.tolerance / next.tolerance) / std::log(more), 1.0,
                    static_cast<double>(highest_time_order));
}

/// How the time of a trial run is passed with another tolerance.
struct Pace {
  double steps_for_one = 1.0;
  double evaluations = 0.0;  ///< of a step, without those at snapshots
};

/// From a step of the trial run alone.
Pace pace_of(const Knowledge& known, const TrialStep& step, double tolerance) {
  constexpr double kLongest = 4.0;  // beyond that an error estimate says nothing any more
  const TrialRun& trial = known.trial;
  Pace pace{1.0, static_cast<double>(step.evaluations - step.moments)};
  if (known.trend.order) {
    // Stiff motions follow their steps with a lower order than that of the scheme.
    pace.steps_for_one = std::pow(trial.tolerance / tolerance, 1.0 / *known.trend.order);
    return pace;
  }
  const double room =
      step.error_estimate > 0.0 ? std::pow(tolerance / step.error_estimate, 1.0 / highest_time_order) : kLongest;
  pace.steps_for_one = 1.0 / (thresholds::step_safety * std::min(room, kLongest));
  return pace;
}

/// Tries that a step of a trial run takes, those that are rejected among them.
double tries_per_step(const TrialRun& trial) {
  double rejected = 0.0;
  for (const TrialStep& step : trial.steps) rejected += step.rejected;
  return 1.0 + rejected / static_cast<double>(trial.steps.size());
}

/// From a stretch with that tolerance or a looser one. A step of j sweeps has order j + 1, and one that begins with the
/// past that of its nodes more, see controlled_sweeps.
Pace pace_of(const Knowledge& known, const Stretch& stretch, double tolerance) {
  const double of_sweep = (evaluations_per_step(highest_time_order) - 1.0) / (highest_time_order - 1.0);
  Pace pace{stretch.steps_for_one, stretch.evaluations};
  const double order =
      std::clamp(1.0 + (pace.evaluations - 1.0) / of_sweep, 1.0, static_cast<double>(highest_time_order));
  const double of_past = stretch.share_with_past * of_sweep;
  pace.steps_for_one *= std::pow(known.sampled / tolerance, 1.0 / (order + of_past));
  pace.evaluations *= tries_per_step(known.trial);
  return pace;
}

/// The one whose place is nearest. How a scene starts tells of nothing else.
const Stretch* nearest(const std::vector<Stretch>& stretches, std::size_t step) {
  const auto away = [step](const Stretch& stretch) {
    return std::pair(stretch.step == 0 && step > 0, std::max(stretch.step, step) - std::min(stretch.step, step));
  };
  const auto found = std::ranges::min_element(stretches, {}, away);
  return found == stretches.end() ? nullptr : &*found;
}

}  // namespace

Trend trend_of(const CostRow& first, const TrialRun& trial, const TrialRun& next) {
  return {degrees_per_digit(first, next), order_between(trial, next)};
}

void Knowledge::learn(TrialRun next) {
  trial = std::move(next);
  known_start = 0;
  if (const double expected = model_seconds(trial.steps, model); expected > 0.0) ratio = trial.seconds / expected;
}

void Knowledge::expect_start(double tolerance) {
  constexpr double kRounding = 1e-9;
  starting_order = 0;
  if (known_start == 0) return;
  const int first = trial.steps.front().order;
  const double more =
      (known_start - first) * std::log(trial.tolerance / tolerance) / std::log(trial.tolerance / start_tolerance);
  // Degrees that runs choose are even.
  const int order = first + 2 * static_cast<int>(std::ceil(std::max(more, 0.0) / 2.0 - kRounding));
  starting_order = std::min(order, default_order(tolerance));
}

void Knowledge::learn_start(double tolerance, int order) {
  starting_order = known_start = order;
  start_tolerance = tolerance;
}

void Knowledge::learn(double tolerance, std::vector<Stretch> of_trial) {
  sampled = tolerance;
  stretches = std::move(of_trial);
  double seconds = 0.0, expected = 0.0;
  for (const Stretch& stretch : stretches) {
    for (const TimedEvaluations& timed : stretch.timed) {
      seconds += timed.seconds;
      expected += timed.count * model.seconds_per_shape(timed.order);
    }
  }
  if (expected > 0.0) ratio = seconds / expected;
}

std::vector<int> predicted_orders(const Knowledge& known, std::size_t index) {
  const TrialRun& trial = known.trial;
  const double tolerance = known.tolerances[index];
  const double digits = std::log10(trial.tolerance / tolerance);
  const int most = default_order(tolerance);
  const int highest =
      std::min(trial.highest_order + static_cast<int>(std::lround(digits * known.trend.degrees_per_digit)), most);
  const auto own =
      static_cast<std::size_t>(std::ranges::find(known.tolerances, trial.tolerance) - known.tolerances.begin());
  int order = known.starting_order, trial_order = 0;
  std::vector<int> orders;
  for (const TrialStep& step : trial.steps) {
    // Runs lower their degree only where it has long been idle, at other tolerances about where the trial run did.
    if (step.order < trial_order) order = 0;
    trial_order = step.order;
    const int idle = std::max(step.order, step.idle_orders[index]);
    if (idle <= order - thresholds::worthwhile_degrees) order = idle;
    // The first step leaves more in the highest degrees than they hold later; what it asks for may be known.
    const bool is_known = orders.empty() && order > 0;
    // As many more or fewer than its spectrum asks for as the trial run had.
    const int needed = step.order + step.orders[index] - step.orders[own];
    order = std::max({order, step.order, is_known ? 0 : std::min(needed, highest)});
    orders.push_back(std::min(order, most));
  }
  return orders;
}

double start_seconds(const Knowledge& known, std::size_t index) {
  const int evaluations = evaluations_per_step(highest_time_order);
  // Degrees that rise to it are evaluated as well.
  constexpr double kOfStart = 4.0;
  return known.ratio * known.model.seconds_per_shape(predicted_orders(known, index).front()) * (kOfStart + evaluations);
}

double stretch_seconds(const Knowledge& known, std::size_t index) {
  const std::vector<int> orders = predicted_orders(known, index);
  double per_shape = 0.0, evaluations = 0.0;
  for (std::size_t i = 0; i < orders.size(); ++i) {
    per_shape += known.model.seconds_per_shape(orders[i]) / static_cast<double>(orders.size());
    evaluations += known.trial.steps[i].evaluations / static_cast<double>(orders.size());
  }
  // Each of the two evolutions evaluates its start.
  const int tight = evaluations_per_step(highest_time_order);
  return known.ratio * per_shape * (2.0 + evaluations + (steps_of_stretch - 1) * tight);
}

CostRow predicted_row(const Knowledge& known, std::size_t index) {
  const TrialRun& trial = known.trial;
  CostRow row;
  row.tolerance = known.tolerances[index];
  const double largest = step_control_of(at_tolerance(known.scene, row.tolerance)).largest;
  const int most = default_order(row.tolerance);
  const std::vector<int> orders = predicted_orders(known, index);
  double steps = 0.0, seconds = 0.0;
  for (std::size_t i = 0; i < trial.steps.size(); ++i) {
    const TrialStep& step = trial.steps[i];
    const Stretch* stretch = nearest(known.stretches, i);
    const Pace pace =
        stretch != nullptr ? pace_of(known, *stretch, row.tolerance) : pace_of(known, step, row.tolerance);
    const double share = std::max(pace.steps_for_one, step.dt / largest);
    const int order = std::min(most, orders[i] + (stretch != nullptr ? stretch->more_degrees : 0));
    steps += share;
    // Snapshots cost an evaluation each, however many steps there are.
    seconds += (share * pace.evaluations + step.moments) * known.model.seconds_per_shape(order);
    row.order = std::max(row.order, order);
  }
  const double covered = trial.steps.empty() ? 1.0 : trial.steps.back().time / known.scene.numerics.end_time;
  row.steps = std::llround(std::ceil(steps / covered));
  row.seconds = known.ratio * seconds / covered;
  return row;
}

}  // namespace vehd
