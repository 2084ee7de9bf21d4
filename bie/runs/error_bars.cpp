#include "bie/runs/error_bars.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/runs/vesicle_rows.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Step of the companion over that of the run; with a tolerance, ratio of their largest steps.
constexpr int companion_steps = 2;

/// Times that differ by rounding are equal.
bool is_before(double a, double b) { return b - a > 1e-12 * std::max(std::abs(a), std::abs(b)); }

Scene scene_of_companion(Scene scene) {
  NumericsScene& numerics = scene.numerics;
  scene.output = {};
  if (!numerics.tolerance) {
    *numerics.dt *= companion_steps;
    return scene;
  }
  *numerics.tolerance *= 10.0;
  // One digit less of accuracy needs 8 degrees less, see default_order.
  numerics.order = std::max(std::min(numerics.order, lowest_adaptive_order), numerics.order - 8);
  return scene;
}

Checkpoint start_of(const std::optional<CompanionState>& from) {
  Checkpoint start;
  if (from) start.state = from->state;
  if (from) start.start_order = from->start_order;
  return start;
}

}  // namespace

ErrorBars::ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks)
    : scene_(scene_of_companion(scene)),
      columns_(history_columns(history_kind(scene))),
      factor_(scene.numerics.tolerance ? 0.5 : 3.0 / (std::pow(companion_steps, scene.numerics.time_order) - 1.0)),
      companion_(scene_, start_of(from), OutputUnits(scene_), std::move(ranks)),
      order_of_results_(scene.numerics.order),
      lab_frame_output_(companion_.problem().frame, settings_of(scene)),
      progress_(from.value_or(CompanionState{.start_order = scene_.numerics.order})) {
  // Otherwise a limit set by the period of the forcing would give both runs equal steps and equal errors.
  companion_.scale_largest_step(companion_steps);
  try {
    if (progress_.lost == 0) companion_.start();
  } catch (const ConvergenceError&) {
    progress_.lost = 1;
  }
}

Vector ErrorBars::values_of(const RecordedSide& side) const {
  HistoryRow row = row_in_laboratory(lab_frame_output_, order_of_results_, side);
  if (row.diagnostics.vesicles.size() > 1) row = row_of_all(row);
  return Vector::NullaryExpr(std::ssize(columns_), [&](Index i) { return columns_[i].value(row); });
}

void ErrorBars::add(const std::vector<RecordedSide>& sides) {
  for (const RecordedSide& side : sides) {
    progress_.waiting.conservativeResize(progress_.waiting.rows() + 1, std::ssize(columns_));
    progress_.waiting.bottomRows<1>() = values_of(side).transpose();
  }
}

std::vector<Vector> ErrorBars::follow(bool to_end) {
  std::vector<Vector> known;
  try {
    if (progress_.lost == 0) compare(known);
    while (progress_.lost == 0 && step(to_end)) compare(known);
  } catch (const ConvergenceError&) {
    progress_.lost = 1;
  }
  if (progress_.lost == 0 || progress_.waiting.size() == 0) return known;
  progress_.waiting.rightCols(progress_.waiting.cols() - 1).setConstant(std::numeric_limits<double>::quiet_NaN());
  for (const auto& row : progress_.waiting.rowwise()) known.emplace_back(row);
  progress_.waiting.resize(0, 0);
  return known;
}

/// Advances the companion by a step, to or past a row. @returns false if the run has not advanced far enough
bool ErrorBars::step(bool to_end) {
  if (progress_.waiting.size() == 0) return false;
  EventTimes events{{}, scene_.numerics.end_time};
  const double last = progress_.waiting(progress_.waiting.rows() - 1, 0);
  const bool adapts = scene_.numerics.tolerance.has_value();
  const double reach = adapts ? companion_.evolution().reach(events) : last;
  const bool has_steps = (progress_.waiting.col(1).array() > 0.0).count() >= companion_steps;
  const bool is_far_enough = to_end || (adapts ? !is_before(last, reach) : has_steps);
  if (!is_far_enough || !is_before(companion_.evolution().state().time, last)) return false;
  for (const double time : progress_.waiting.col(0)) {
    if (time <= reach) events.snapshots.times = {time};
  }
  companion_.step(events);
  return true;
}

/// Compares rows that the companion has reached, and appends the errors of these and of the rows before them.
void ErrorBars::compare(std::vector<Vector>& known) {
  for (const RecordedSide& side : companion_.sides()) {
    Matrix& waiting = progress_.waiting;
    Index here = 0;
    while (here < waiting.rows() && is_before(waiting(here, 0), side.row.time)) ++here;
    if (here == waiting.rows() || is_before(side.row.time, waiting(here, 0))) continue;
    const Vector run = waiting.row(here), companion = values_of(side);
    Vector differences = (run - companion).cwiseAbs();
    differences[0] = run[0];
    for (Index i = 1; i < run.size(); ++i) {
      // NaN or the same infinity in both is no difference.
      if (run[i] == companion[i] || (std::isnan(run[i]) && std::isnan(companion[i]))) differences[i] = 0.0;
      if (columns_[i].name == "inclination_deg") differences[i] = std::min(differences[i], 180.0 - differences[i]);
    }
    for (Index row = 0; row <= here; ++row) known.push_back(bars_of(waiting.row(row), differences));
    waiting = waiting.bottomRows(waiting.rows() - here - 1).eval();
    progress_.former = differences;
  }
}

/// A row of history_error.csv. @param differences  at the first comparison at or after this row
Vector ErrorBars::bars_of(const Vector& row, Vector differences) const {
  // Not across a jump: its two sides have different errors.
  if (progress_.former.size() > 0 && progress_.former[0] < row[0]) differences = differences.cwiseMax(progress_.former);
  const auto truncation = std::ranges::find(columns_, "truncation", &HistoryColumn::name) - columns_.begin();
  // With fixed steps both runs have the same degree, and truncation is left out.
  if (scene_.numerics.tolerance) differences += row[truncation] * row.cwiseAbs();
  Vector bars = row.cwiseAbs();
  for (Index i = 1; i < row.size(); ++i) {
    if (columns_[i].meaning == ColumnMeaning::method) bars[i] = 0.0;
    if (columns_[i].meaning == ColumnMeaning::quantity) bars[i] = factor_ * differences[i];
  }
  return bars;
}

CompanionState ErrorBars::state() const {
  CompanionState state = progress_;
  state.state = companion_.evolution().state();
  return state;
}

}  // namespace vehd
