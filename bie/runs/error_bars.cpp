#include "bie/runs/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <utility>

#include "bie/runs/vesicle_rows.hpp"
#include "bie/runs/worst_error.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// How much larger the tolerance of the companion is: a digit. More makes it cheaper, but what the motion makes of its
/// errors then differs from what it makes of those of the run. Measured (docs/run_files.md).
constexpr double companion_looseness = 10.0;
/// Degrees that the companion does without: those of a digit, see accuracy_defaults.
constexpr int companion_degrees = 8;
/// How much larger the largest steps of the companion are. Where the period of the forcing limits the steps of both,
/// those of the same size would be wrong by the same; two of eight in a period leave four.
constexpr double companion_stride = 2.0;
/// Steps of the run from one comparison to the next at least: solving at a moment within a step costs about half of a
/// step of the run.
constexpr int steps_to_moment = 2;
/// Fixed steps that are one of the companion.
constexpr int companion_steps = 3;

/// Moments that differ by rounding are one.
bool is_same_time(double a, double b) { return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b)); }

Scene scene_of_companion(Scene scene) {
  NumericsScene& numerics = scene.numerics;
  if (numerics.tolerance) {
    *numerics.tolerance *= companion_looseness;
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

/// Error that steps leave of the run over its difference to the companion's. What a tolerance leaves is proportional to
/// it; that of fixed steps is Δt^k, so the companion has 3^k of it.
double share_of_difference(const NumericsScene& numerics) {
  if (numerics.tolerance) return 1.0 / (companion_looseness - 1.0);
  return 1.0 / (std::pow(companion_steps, static_cast<double>(numerics.time_order)) - 1.0);
}

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

/// Errors of a row between two others: what is wrong grows and dies away exponentially.
Vector between(const Vector& first, const Vector& last, const Vector& run, HistoryKind kind) {
  const double share = (run[0] - first[0]) / (last[0] - first[0]);
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

}  // namespace

ErrorBars::ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks)
    : scene_(scene_of_companion(scene)),
      kind_(history_kind(scene)),
      share_of_steps_(share_of_difference(scene.numerics)),
      order_of_results_(scene.numerics.order),
      start_order_(from ? from->start_order : scene_.numerics.order),
      companion_(scene_, start_of(from), OutputUnits(scene_), std::move(ranks)),
      lab_frame_output_(companion_.problem().frame, settings_of_results(companion_.problem(), order_of_results_)) {
  companion_.allow_steps(companion_stride);
  if (!from) return;
  node_ = from->node;
  sizes_ = from->sizes;
  lost_ = from->lost != 0;
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

/// Error of the run over its differences to the companion.
double ErrorBars::share_of(const Vector& differences, const Vector& run, const Vector& companion,
                           double step_error) const {
  // Fixed steps have the same degree.
  if (!scene_.numerics.tolerance) return share_of_steps_;
  const double difference = worst(differences);
  if (!(difference > 0.0)) return share_of_steps_;
  const Index truncation = index_of("truncation", kind_);
  // Steps and degrees are wrong independently of each other, so squares add up.
  const double of_degrees = std::min(1.0, companion[truncation] / difference);
  const double of_steps = std::sqrt((1.0 - of_degrees) * (1.0 + of_degrees));
  const double share_of_degrees = run[truncation] / std::max(companion[truncation], difference);
  return std::hypot(std::max(share_of_steps_ * of_steps, std::min(share_of_steps_, step_error / difference)),
                    share_of_degrees);
}

Vector ErrorBars::errors_at(const Vector& run, const RecordedSide& companion, double step_error) const {
  const Vector there = values_of(companion);
  Vector errors = differences_of(run, there, kind_);
  const double share = share_of(errors, run, there, step_error);
  const std::vector<HistoryColumn>& columns = history_columns(kind_);
  for (Index i = 1; i < errors.size(); ++i) {
    if (columns[static_cast<std::size_t>(i)].meaning == ColumnMeaning::quantity) errors[i] *= share;
  }
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
  const double reach = companion_.evolution().reach(events);
  if (!to_end && last < reach && !is_same_time(last, reach)) return false;
  if (const std::optional<double> moment = moment_before(reach)) events.snapshots.times = {*moment};
  companion_.step(events);
  return true;
}

/// The last row within the next step of the companion, unless the last comparison was not long ago. None of them is
/// met by a step that turns out shorter; one at its end is met in any case.
std::optional<double> ErrorBars::moment_before(double reach) const {
  std::optional<double> moment;
  int n_steps = 0;
  for (const Vector& row : waiting_) {
    if (row[0] > reach) break;
    // Rows within a step have no size.
    if (row[1] > 0.0) ++n_steps;
    if (n_steps >= steps_to_moment && row[0] > now() && !is_same_time(row[0], now())) moment = row[0];
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
    const Vector arrival = errors_at(*here, side, step_error_until(*here));
    for (; !is_here(waiting_.front()); waiting_.pop_front()) {
      known.push_back(between(node_, arrival, waiting_.front(), kind_));
    }
    node_ = arrival;
    known.push_back(node_);
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
  CompanionState state{companion_.evolution().state(), start_order_, lost_ ? 1 : 0, node_, {}, sizes_};
  state.waiting.resize(std::ssize(waiting_), node_.size());
  for (Index i = 0; i < state.waiting.rows(); ++i) {
    state.waiting.row(i) = waiting_[static_cast<std::size_t>(i)].transpose();
  }
  return state;
}

}  // namespace vehd
