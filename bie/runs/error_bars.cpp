#include "bie/runs/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "bie/runs/vesicle_rows.hpp"
#include "bie/runs/worst_error.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// How much larger the tolerance of the companion is: a digit. More makes it cheaper, but what the motion makes of its
/// errors then differs from what it makes of those of the run. Measured (docs/run_files.md).
constexpr double companion_looseness = 10.0;
/// Order of its steps, or one less than those of the run: of the same order they may be nearly those of the run, and as
/// wrong. Not lower than the second, which estimates errors.
constexpr int order_of_companion = 3;
constexpr int lowest_estimating_order = 2;
/// Degrees that the companion does without: those of a digit, see default_order.
constexpr int companion_degrees = 8;
/// How much larger the largest steps of the companion are. Where the period of the forcing limits the steps of both,
/// those of the same size would be wrong by the same; two of eight in a period leave four.
constexpr double companion_stride = 2.0;
/// Steps of the run from one comparison to the next at least: solving at a moment within a step costs about half of a
/// step of the run. The latter of a companion that is frugal.
constexpr int steps_to_moment = 2;
constexpr int steps_to_frugal_moment = 5;
/// Share of the work of the run from which on the companion is frugal: what it writes and starts with comes on top.
constexpr double frugal_share = 0.2;
/// Steps of the companion that come before, as the first ones of both say little.
constexpr std::int64_t steps_before_frugal = 25;
/// By so much of its size a step of a frugal companion may be shortened to end on a row.
constexpr double most_shortened = 0.3;
/// Weight of the comparison before in the mean of logarithms with it: what is wrong passes through zero now and then.
/// Measured.
constexpr double weight_of_former = 0.3;
/// Share of what the degrees of a row leave out by its spectrum that it is wrong by at least. Measured.
constexpr double share_of_truncation = 0.3;
/// Fixed steps that are one of the companion.
constexpr int companion_steps = 3;

/// Moments that differ by rounding are one.
bool is_same_time(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

/// Whether a period or dt limits the steps of a run with a tolerance.
bool has_limited_steps(const Scene& scene) {
  return scene.numerics.tolerance && step_control_of(scene).largest < scene.numerics.end_time;
}

Scene scene_of_companion(Scene scene) {
  NumericsScene& numerics = scene.numerics;
  if (numerics.tolerance) {
    *numerics.tolerance *= companion_looseness;
    const int lower = std::min(order_of_companion, numerics.time_order - 1);
    numerics.time_order = std::max(std::min(numerics.time_order, lowest_estimating_order), lower);
    numerics.order = std::max(std::min(numerics.order, lowest_adaptive_order), numerics.order - companion_degrees);
  } else {
    *numerics.dt *= companion_steps;
  }
  scene.output.every.reset();
  scene.output.times.clear();
  scene.output.windows.clear();
  return scene;
}

NumericalSettings settings_of_results(const Problem& problem, int order) {
  NumericalSettings settings = problem.settings;
  settings.order = order;
  return settings;
}

Checkpoint start_of(const std::optional<CompanionState>& from) {
  Checkpoint start;
  if (!from) return start;
  start.state = from->state;
  start.start_order = from->start_order;
  return start;
}

/// Of a step, or of none: evaluations take about the cube of the degree.
double work_of(const HistoryRow& row) { return row.step.evaluations * std::pow(row.order + 1.0, 3); }

Index index_of(std::string_view column, HistoryKind kind) {
  return std::ranges::distance(history_columns(kind).begin(),
                               std::ranges::find(history_columns(kind), column, &HistoryColumn::name));
}

/// Of one row, behind its time; what is an error itself stays.
Vector differences_of(const Vector& run, const Vector& companion, HistoryKind kind) {
  const std::vector<HistoryColumn>& columns = history_columns(kind);
  Vector differences = Vector::Zero(run.size());
  differences[0] = run[0];
  for (Index i = 1; i < run.size(); ++i) {
    const HistoryColumn& column = columns[static_cast<std::size_t>(i)];
    if (column.meaning == ColumnMeaning::method) continue;
    if (column.meaning == ColumnMeaning::error) {
      differences[i] = std::abs(run[i]);
      continue;
    }
    // What neither has is no difference.
    const bool are_equal = run[i] == companion[i] || (std::isnan(run[i]) && std::isnan(companion[i]));
    if (are_equal) continue;
    double difference = std::abs(run[i] - companion[i]);
    if (column.name == "inclination_deg") difference = std::min(difference, 180.0 - difference);
    differences[i] = difference;
  }
  return differences;
}

/// Errors of a row from those of two others, by the mean of their logarithms.
/// @param share  of the last one
Vector mean_of(const Vector& first, const Vector& last, double share, const Vector& run, HistoryKind kind) {
  const std::vector<HistoryColumn>& columns = history_columns(kind);
  Vector errors = Vector::Zero(run.size());
  errors[0] = run[0];
  for (Index i = 1; i < run.size(); ++i) {
    if (columns[static_cast<std::size_t>(i)].meaning == ColumnMeaning::error) {
      errors[i] = std::abs(run[i]);
      continue;
    }
    // Nothing grows out of zero in this way.
    errors[i] = first[i] > 0.0 && last[i] > 0.0 ? std::pow(first[i], 1.0 - share) * std::pow(last[i], share)
                                                : (1.0 - share) * first[i] + share * last[i];
  }
  return errors;
}

/// Of a row between two others: what is wrong grows and dies away exponentially.
Vector between(const Vector& first, const Vector& last, const Vector& run, HistoryKind kind) {
  return mean_of(first, last, (run[0] - first[0]) / (last[0] - first[0]), run, kind);
}

void scale_quantities(Vector& errors, double factor, HistoryKind kind) {
  const std::vector<HistoryColumn>& columns = history_columns(kind);
  for (Index i = 1; i < errors.size(); ++i) {
    if (columns[static_cast<std::size_t>(i)].meaning == ColumnMeaning::quantity) errors[i] *= factor;
  }
}

}  // namespace

ErrorBars::ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks)
    : scene_(scene_of_companion(scene)),
      kind_(history_kind(scene)),
      time_order_of_run_(scene.numerics.time_order),
      has_limited_steps_(has_limited_steps(scene)),
      order_of_results_(scene.numerics.order),
      start_order_(from ? from->start_order : scene_.numerics.order),
      companion_(scene_, start_of(from), OutputUnits(scene_), std::move(ranks)),
      lab_frame_output_(companion_.problem().frame, settings_of_results(companion_.problem(), order_of_results_)) {
  companion_.allow_steps(companion_stride);
  if (!from) return;
  node_ = from->node;
  sizes_ = from->sizes;
  lost_ = from->lost != 0;
  if (from->work.size() == 2) work_ = {from->work[0], from->work[1]};
  for (Index i = 0; i < from->waiting.rows(); ++i) waiting_.emplace_back(from->waiting.row(i).transpose());
}

void ErrorBars::start() {
  try {
    if (!lost_) companion_.start();
  } catch (const ConvergenceError&) {
    lost_ = true;
  }
}

Vector ErrorBars::values_of(const RecordedSide& side) const {
  const HistoryRow shown = row_in_laboratory(lab_frame_output_, order_of_results_, side);
  return vehd::values_of(kind_.rows == HistoryKind::of_all ? row_of_all(shown) : shown, kind_);
}

void ErrorBars::add(const std::vector<RecordedSide>& sides) {
  for (const RecordedSide& side : sides) {
    work_.of_run += work_of(side.row);
    const Vector& row = waiting_.emplace_back(values_of(side));
    if (sizes_.size() == 0) sizes_ = Vector::Zero(row.size());
    for (Index i = 0; i < row.size(); ++i) {
      // What is not a number has no size.
      if (std::abs(row[i]) > sizes_[i]) sizes_[i] = std::abs(row[i]);
    }
  }
}

/// The largest of those that count, over the size of its column.
double ErrorBars::worst(const Vector& differences) const {
  const std::vector<HistoryColumn>& columns = history_columns(kind_);
  const auto largest = [this](const std::string& name) { return sizes_[index_of(name, kind_)]; };
  double worst = 0.0;
  for (Index i = 1; i < differences.size(); ++i) {
    const double size = size_of_column(columns[static_cast<std::size_t>(i)].name, largest);
    if (size > 0.0 && differences[i] > worst * size) worst = differences[i] / size;
  }
  return worst;
}

/// What the run's last step until this row has left, or the one that passes it, as the run has estimated it.
double ErrorBars::step_error_until(const Vector& row) const {
  const Index dt = index_of("dt", kind_), estimate = index_of("error_estimate", kind_);
  std::optional<double> error;
  for (const Vector& other : waiting_) {
    const bool is_later = other[0] > row[0] && !is_same_time(other[0], row[0]);
    if (is_later && error) break;
    // Rows within a step have no size.
    if (other[dt] > 0.0) error = thresholds::step_share * other[estimate];
  }
  return error.value_or(0.0);
}

/// How many times as wrong as those of the run the steps of the companion are. That of fixed steps is Δt^k. What a
/// tolerance leaves is proportional to it, unless something else limits the steps of either; what both have estimated
/// of their steps tells, but not of errors that have come before. So it is the geometric mean of the two.
/// @param difference  of the two runs: one much larger than what the last step may have left has come before
double ErrorBars::ratio_of_steps(double difference) const {
  if (!scene_.numerics.tolerance) return std::pow(companion_steps, static_cast<double>(time_order_of_run_));
  double of_companion = 0.0;
  for (const RecordedSide& side : companion_.sides()) {
    if (side.row.step.dt > 0.0) of_companion = side.row.step.error_estimate;
  }
  const Index dt = index_of("dt", kind_), estimate = index_of("error_estimate", kind_);
  double sum = 0.0;
  int n_steps = 0;
  for (const Vector& row : waiting_) {
    const double start = row[0] - row[dt];
    // Rows within a step have no size.
    if (!(row[dt] > 0.0 && row[estimate] > 0.0) || start >= now() || is_same_time(start, now())) continue;
    sum += std::log(row[estimate]);
    ++n_steps;
  }
  if (n_steps == 0 || !(companion_looseness * of_companion > difference)) return companion_looseness;
  const double ratio = of_companion / std::exp(sum / n_steps);
  return std::sqrt(companion_looseness * std::max(ratio, 1.0));
}

/// Error of the run over its differences to the companion.
double ErrorBars::share_of(const Vector& differences, const Vector& run, const Vector& companion) const {
  const double difference = worst(differences), share_of_steps = 1.0 / (ratio_of_steps(difference) - 1.0);
  // Fixed steps have the same degree.
  if (!scene_.numerics.tolerance) return share_of_steps;
  const double step_error = step_error_until(run);
  if (!(difference > 0.0)) return share_of_steps;
  const Index truncation = index_of("truncation", kind_);
  // Steps and degrees are wrong independently of each other, so squares add up.
  const double of_degrees = std::min(1.0, companion[truncation] / difference);
  const double of_steps = std::sqrt((1.0 - of_degrees) * (1.0 + of_degrees));
  const double share_of_degrees = run[truncation] / std::max(companion[truncation], difference);
  return std::hypot(std::max(share_of_steps * of_steps, std::min(share_of_steps, step_error / difference)),
                    share_of_degrees);
}

Vector ErrorBars::errors_at(const Vector& run, const RecordedSide& companion) const {
  const Vector there = values_of(companion);
  Vector errors = differences_of(run, there, kind_);
  scale_quantities(errors, share_of(errors, run, there), kind_);
  // The shape at the start was not made by steps, and on either side of a jump columns have other errors.
  const bool has_former = scene_.numerics.tolerance && node_.size() > 0 && node_[0] > 0.0 && node_[0] < errors[0];
  return has_former ? mean_of(node_, errors, 1.0 - weight_of_former, run, kind_) : errors;
}

/// A row of history_error.csv: what the degrees leave out is known of every row.
Vector ErrorBars::told(const Vector& run, Vector errors) const {
  if (!scene_.numerics.tolerance) return errors;
  const double least = share_of_truncation * run[index_of("truncation", kind_)], found = worst(errors);
  if (found > 0.0 && found < least) scale_quantities(errors, least / found, kind_);
  return errors;
}

std::vector<Vector> ErrorBars::follow(bool to_end) {
  std::vector<Vector> known;
  try {
    if (!lost_ && node_.size() == 0) compare(known);
    while (!lost_ && follow_once(to_end)) compare(known);
  } catch (const ConvergenceError&) {
    lost_ = true;
  }
  if (lost_) give_up(known);
  return known;
}

/// One step of the companion, or as many as it takes from a fixed end to the next. @returns false if the run has not
/// gone far enough
bool ErrorBars::follow_once(bool to_end) {
  if (waiting_.empty()) return false;
  EventTimes events{{}, scene_.numerics.end_time};
  if (!scene_.numerics.tolerance) {
    events.discontinuity = fixed_end(to_end);
    if (!events.discontinuity) return false;
    const double end = *events.discontinuity;
    while (now() < end && !is_same_time(now(), end)) companion_.step(events);
    return true;
  }
  const double last = waiting_.back()[0];
  if (last <= now() || is_same_time(last, now())) return false;
  const bool frugal = is_frugal();
  companion_.set_time_order(frugal ? time_order_of_run_ : scene_.numerics.time_order);
  const double reach = companion_.evolution().reach(events);
  if (!to_end && last < reach && !is_same_time(last, reach)) return false;
  if (const std::optional<double> end = frugal ? row_near(reach) : std::nullopt) {
    if (!is_same_time(*end, reach)) events.discontinuity = end;
  } else if (const std::optional<double> moment =
                 moment_before(reach, frugal ? steps_to_frugal_moment : steps_to_moment)) {
    events.snapshots.times = {*moment};
  }
  companion_.step(events);
  for (const RecordedSide& side : companion_.sides()) work_.of_companion += work_of(side.row);
  return true;
}

/// Where the order of the run makes larger steps, and comparisons are to cost nothing.
bool ErrorBars::is_frugal() const {
  return has_limited_steps_ || (companion_.evolution().state().step >= steps_before_frugal &&
                                work_.of_companion > frugal_share * work_.of_run);
}

/// The last row where the next step of the companion may as well end: what is solved for there serves as the start of
/// the step behind it.
std::optional<double> ErrorBars::row_near(double reach) const {
  std::optional<double> near;
  for (const Vector& row : waiting_) {
    if (row[0] > reach && !is_same_time(row[0], reach)) break;
    if (row[0] >= now() + (1.0 - most_shortened) * (reach - now())) near = row[0];
  }
  return near;
}

/// The last row within the next step of the companion, unless the last comparison was not long ago. None of them is
/// met by a step that turns out shorter; one at its end is met in any case.
/// @param least  steps of the run since then
std::optional<double> ErrorBars::moment_before(double reach, int least) const {
  std::optional<double> moment;
  int n_steps = 0;
  for (const Vector& row : waiting_) {
    if (row[0] > reach) break;
    // Rows within a step have no size.
    if (row[1] > 0.0) ++n_steps;
    if (n_steps >= least && row[0] > now() && !is_same_time(row[0], now())) moment = row[0];
  }
  return moment;
}

/// The row at which a companion of fixed steps is to end its next step: none if the run has not gone far enough.
std::optional<double> ErrorBars::fixed_end(bool to_end) const {
  int n_steps = 0;
  for (std::size_t i = 0; i < waiting_.size(); ++i) {
    const double time = waiting_[i][0];
    // Rows within a step have no size.
    if (waiting_[i][1] > 0.0 && ++n_steps == companion_steps) return time;
    // Nothing is continued beyond a jump.
    if (i + 1 < waiting_.size() && waiting_[i + 1][0] == time) return time;
  }
  return to_end ? std::optional(waiting_.back()[0]) : std::nullopt;
}

/// The companion has come to where rows wait, or passed them.
void ErrorBars::compare(std::vector<Vector>& known) {
  for (const RecordedSide& side : companion_.sides()) {
    const auto is_here = [&](const Vector& row) { return is_same_time(row[0], side.row.time); };
    const auto here = std::ranges::find_if(waiting_, is_here);
    if (here == waiting_.end()) continue;
    const Vector arrival = errors_at(*here, side);
    for (; !is_here(waiting_.front()); waiting_.pop_front()) {
      known.push_back(told(waiting_.front(), between(node_, arrival, waiting_.front(), kind_)));
    }
    node_ = arrival;
    known.push_back(told(waiting_.front(), node_));
    waiting_.pop_front();
  }
}

/// Nothing is known of the rows that wait.
void ErrorBars::give_up(std::vector<Vector>& known) {
  for (; !waiting_.empty(); waiting_.pop_front()) {
    Vector& errors =
        known.emplace_back(Vector::Constant(waiting_.front().size(), std::numeric_limits<double>::quiet_NaN()));
    errors[0] = waiting_.front()[0];
  }
}

CompanionState ErrorBars::state() const {
  CompanionState state{companion_.evolution().state(),
                       start_order_,
                       lost_ ? 1 : 0,
                       node_,
                       {},
                       sizes_,
                       Vector{{work_.of_run, work_.of_companion}}};
  state.waiting.resize(std::ssize(waiting_), sizes_.size());
  for (Index i = 0; i < state.waiting.rows(); ++i) {
    state.waiting.row(i) = waiting_[static_cast<std::size_t>(i)].transpose();
  }
  return state;
}

}  // namespace vehd
