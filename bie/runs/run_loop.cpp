#include "bie/runs/run_loop.hpp"

#include <fmt/format.h>

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_units.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

Checkpoint start_of(const RunTask& task) { return task.checkpoint.value_or(Checkpoint{}); }

OutputUnits units_of(const RunTask& task) {
  return start_of(task).history_bytes > 0 ? units_of_history(task.paths.history(), task.scene.units)
                                          : OutputUnits(task.scene);
}

NumericalSettings settings_of_files(const RunTask& task, NumericalSettings settings) {
  settings.order = order_of_files(task.scene, start_of(task), task.paths);
  return settings;
}

std::unique_ptr<ErrorBars> error_bars_of(const RunTask& task) {
  if (!task.scene.numerics.error_bars) return nullptr;
  return std::make_unique<ErrorBars>(task.scene, start_of(task).companion, task.ranks);
}

Checkpoint with_companion(Checkpoint start, const ErrorBars* error_bars) {
  if (error_bars != nullptr && !start.companion) start.companion = error_bars->state();
  return start;
}

RunOutcome advance_to_end(RecordedRun& run, const Ranks& ranks, Interruption& interruption) {
  try {
    run.start();
    const Simulation& simulation = run.simulation();
    while (!simulation.at_end()) {
      if (ranks.any(interruption.requested())) {
        const std::string now = simulation.time_text(simulation.evolution().state().time);
        return {.completed = false, .reason = fmt::format("a signal came at time {}", now)};
      }
      run.step();
    }
    return {.completed = true, .reason = {}};
  } catch (const ConvergenceError& error) {
    return run.failed(error);
  }
}

}  // namespace

RecordedRun::RecordedRun(const RunTask& task)
    : simulation_(task.scene, start_of(task), units_of(task), task.ranks),
      error_bars_(error_bars_of(task)),
      ranks_(task.ranks),
      is_recorded_(start_of(task).n_rows > 0),
      tell_(task.tell),
      after_step_(task.after_step) {
  // Others may still be reading what the first is about to change.
  ranks_.meet();
  ranks_.together([&] {
    if (!ranks_.is_first()) return;
    recorder_.emplace(task.paths, settings_of_files(task, simulation_.problem().settings), simulation_.problem().frame,
                      with_companion(simulation_.checkpoint(), error_bars_.get()), simulation_.units(),
                      history_kind(task.scene), task.checkpoint_lag);
  });
}

void RecordedRun::record() {
  const Simulation& simulation = simulation_;
  const std::vector<RecordedSide> sides = simulation.sides();
  std::vector<Vector> known;
  if (error_bars_) {
    error_bars_->add(sides);
    known = error_bars_->follow(simulation.at_end());
  }
  const RunTotals totals = simulation.totals();
  ranks_.together([&] {
    if (!recorder_) return;
    if (error_bars_) recorder_->record_errors(known, error_bars_->state());
    recorder_->record(simulation.evolution().state(), sides, totals);
  });
  is_recorded_ = true;
  if (tell_) tell_(simulation.status());
}

void RecordedRun::start() {
  simulation_.start();
  if (error_bars_) error_bars_->start();
  if (!is_recorded_) record();
}

void RecordedRun::step() {
  simulation_.step();
  record();
  if (after_step_) after_step_();
}

RunOutcome RecordedRun::failed(const ConvergenceError& error) {
  ranks_.together([&] {
    if (recorder_) recorder_->keep_last_state(simulation_.evolution().evaluation().fields);
  });
  return {.completed = false, .reason = error.what(), .cannot_step = true};
}

void RecordedRun::end(const RunOutcome& outcome) {
  const RunTotals totals = simulation_.totals();
  ranks_.together([&] {
    if (!recorder_) return;
    recorder_->end_session(totals);
    if (outcome.completed) recorder_->finish();
  });
}

RunOutcome simulate(const RunTask& task, Interruption& interruption) {
  RecordedRun run(task);
  try {
    const RunOutcome outcome = advance_to_end(run, task.ranks, interruption);
    run.end(outcome);
    return outcome;
  } catch (const OutputError& error) {
    return {.completed = false, .reason = error.what()};
  }
}

}  // namespace vehd
