#include "bie/runs/run_loop.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

Checkpoint start_of(const RunTask& task) { return task.checkpoint.value_or(Checkpoint{}); }

OutputUnits units_of(const RunTask& task) {
  ReadingNotes notes;
  return start_of(task).history_bytes > 0 ? units_of_run(task.paths, task.scene.units, notes) : OutputUnits(task.scene);
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

/// Threads of the companion, whose work is a fraction of that of the run.
int threads_beside(int n_threads) {
  constexpr int kPart = 4;
  return std::max(1, n_threads / kPart);
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
    // A run that ends at rest has no snapshot at that time yet.
    if (simulation.evolution().state().time < simulation.scene().numerics.end_time) run.keep_last_state();
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
      on_status_(task.on_status) {
  // Other ranks may still be reading files that the first rank is about to change.
  ranks_.meet();
  ranks_.collective([&] {
    if (!ranks_.is_first()) return;
    recorder_.emplace(task.paths, settings_of_files(task, simulation_.problem().settings), simulation_.problem().frame,
                      with_companion(simulation_.checkpoint(), error_bars_.get()), simulation_.units(),
                      history_kind(task.scene), model_of(task.scene).wall, task.checkpoint_lag);
  });
}

/// Records known errors and the state of the companion.
void RecordedRun::record_errors(const std::vector<Vector>& errors) {
  if (!error_bars_) return;
  ranks_.collective([&] {
    if (recorder_) recorder_->record_errors(errors, error_bars_->state());
  });
}

/// Records the last step, and the errors that became known meanwhile.
void RecordedRun::record(std::vector<Vector> errors) {
  const Simulation& simulation = simulation_;
  const std::vector<RecordedSide> sides = simulation.sides();
  if (error_bars_) error_bars_->add(sides);
  if (simulation.at_end()) std::ranges::move(errors_until(true), std::back_inserter(errors));
  record_errors(errors);
  const RunTotals totals = simulation.totals();
  ranks_.collective([&] {
    if (recorder_) recorder_->record(simulation.evolution().state(), sides, totals);
  });
  is_recorded_ = true;
  if (on_status_) on_status_(simulation.status());
}

void RecordedRun::start() {
  simulation_.start();
  if (!is_recorded_) record({});
}

/// Errors of the rows that the companion can reach. @param end  no further rows will come
std::vector<Vector> RecordedRun::errors_until(bool end) {
  return error_bars_ ? error_bars_->follow(end) : std::vector<Vector>();
}

/// Advances the companion as far as the rows allow; in parallel with the run if there is more than one thread.
std::future<std::vector<Vector>> RecordedRun::following() {
  const int n_threads = omp_get_max_threads();
  const bool beside = error_bars_ && n_threads > 1 && ranks_.is_alone();
  return std::async(beside ? std::launch::async : std::launch::deferred, [this, beside, n_threads] {
    if (beside) omp_set_num_threads(threads_beside(n_threads));
    return errors_until(false);
  });
}

void RecordedRun::step() {
  std::future<std::vector<Vector>> errors = following();
  try {
    simulation_.step();
  } catch (const ConvergenceError&) {
    record_errors(errors.get());
    throw;
  }
  record(errors.get());
}

void RecordedRun::snapshot() {
  const RunTotals totals = simulation_.totals();
  ranks_.collective([&] {
    if (!recorder_) return;
    recorder_->keep_last_state(simulation_.evolution().evaluation().fields);
    recorder_->end_session(totals);
  });
}

void RecordedRun::keep_last_state() {
  ranks_.collective([&] {
    if (recorder_) recorder_->keep_last_state(simulation_.evolution().evaluation().fields);
  });
}

RunOutcome RecordedRun::failed(const ConvergenceError& error) {
  keep_last_state();
  return {.completed = false, .reason = error.what(), .cannot_step = true};
}

void RecordedRun::end(const RunOutcome& outcome) {
  record_errors(errors_until(simulation_.at_end()));
  const RunTotals totals = simulation_.totals();
  ranks_.collective([&] {
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
