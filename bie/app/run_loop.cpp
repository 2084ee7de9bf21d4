#include "bie/app/run_loop.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bie/app/errors.hpp"
#include "bie/app/run_recorder.hpp"
#include "bie/app/step_plan.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/stepper.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Smallest step, as a part of the scene's dt, that is tried before a run gives up.
constexpr double smallest_step_fraction = 1.0 / 1024.0;

/// Thrown inside the loop when no acceptable step exists.
class StepFailure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Work of this session on top of that of former ones.
class WorkMeter {
 public:
  WorkMeter(RunTotals before, const Instruments& instruments) : before_(std::move(before)), instruments_(instruments) {}

  [[nodiscard]] RunTotals totals() const {
    RunTotals totals = before_;
    totals.seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    for (const auto& [name, count] : instruments_.kernel_evaluations()) totals.kernel_evaluations[name] += count;
    for (const auto& [name, seconds] : instruments_.seconds()) totals.seconds_of_parts[name] += seconds;
    return totals;
  }

 private:
  RunTotals before_;
  const Instruments& instruments_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Simulation {
 public:
  explicit Simulation(const RunTask& task)
      : scene_(task.scene),
        problem_(problem_of(task.scene)),
        discretisation_(problem_.settings, problem_.symmetry),
        start_(task.checkpoint ? *task.checkpoint : first_checkpoint()),
        meter_(start_.totals, instruments_),
        state_(start_.state),
        recorder_(task.paths, discretisation_, problem_.frame, updated(start_)),
        progress_(task.progress, state_.time, task.scene.numerics.end_time) {}

  RunOutcome run(Interruption& interruption) {
    RunOutcome outcome;
    try {
      start();
      while (state_.time < scene_.numerics.end_time && outcome.reason.empty()) {
        if (interruption.requested()) {
          outcome.reason = "stopped by a signal";
        } else {
          take_step();
        }
      }
      outcome.completed = outcome.reason.empty();
      recorder_.update_totals(meter_.totals());
      if (outcome.completed) recorder_.finish();
    } catch (const ConvergenceError& error) {
      outcome.reason = error.what();
    } catch (const StepFailure& error) {
      outcome.reason = error.what();
    } catch (const OutputError& error) {
      outcome.reason = error.what();
    }
    progress_.finish();
    return outcome;
  }

 private:
  Checkpoint first_checkpoint() {
    Checkpoint checkpoint;
    const bool steady = scene_.electric.has_value() && scene_.electric->initial_potential == InitialPotential::steady;
    checkpoint.state =
        initial_state(problem_.model, discretisation_, problem_.position, steady, scene_.numerics.dt, instruments_);
    return checkpoint;
  }

  /// The end and the snapshot times may differ from those of the former session.
  [[nodiscard]] Checkpoint updated(Checkpoint checkpoint) const {
    checkpoint.scene = effective_scene(scene_);
    checkpoint.threads = omp_get_max_threads();
    return checkpoint;
  }

  void start() {
    evaluation_ = evaluate(problem_.model, discretisation_, state_, instruments_);
    if (recorder_.n_rows() > 0) return;
    HistoryRow row;
    row.iterations_flow = evaluation_.iterations_flow;
    row.iterations_electric = evaluation_.iterations_electric;
    record(row, true);
  }

  void take_step() {
    StepPlan plan =
        plan_step(state_.time, state_.dt_next,
                  {scene_.output.every, scene_.numerics.end_time, next_corner(problem_.model, state_.time)});
    HistoryRow row;
    for (;;) {
      Advance advanced = try_step(plan, row);
      try {
        Evaluation evaluation = evaluate(problem_.model, discretisation_, advanced.state, instruments_, &evaluation_);
        row.dt = advanced.dt;
        row.iterations_flow += evaluation.iterations_flow;
        row.iterations_electric += evaluation.iterations_electric;
        const bool at_event = plan.reaches_event && advanced.dt == plan.dt_limit;
        if (at_event) advanced.state.time = plan.event_time;
        state_ = std::move(advanced.state);
        evaluation_ = std::move(evaluation);
        record(row, at_event && plan.is_snapshot);
        return;
      } catch (const ConvergenceError& error) {
        // The new state cannot be solved for, so the step that led there is rejected as well.
        ++row.rejected;
        plan.dt_limit = advanced.dt / 2.0;
        plan.reaches_event = false;
        if (plan.dt_limit < scene_.numerics.dt * smallest_step_fraction) throw StepFailure(error.what());
      }
    }
  }

  Advance try_step(const StepPlan& plan, HistoryRow& row) {
    State from = state_;
    // Equal up to rounding: the step must end on the event, not just before it.
    if (plan.reaches_event) from.dt_next = std::max(from.dt_next, plan.dt_limit);
    Advance advanced =
        advance(problem_.model, discretisation_, from, evaluation_, scene_.numerics.dt, plan.dt_limit, instruments_);
    row.rejected += advanced.rejected;
    row.iterations_flow += advanced.iterations_flow;
    row.iterations_electric += advanced.iterations_electric;
    if (!advanced.accepted) {
      throw StepFailure(fmt::format("no acceptable step from time {:g}: {}", state_.time, advanced.reason));
    }
    return advanced;
  }

  void record(HistoryRow& row, bool with_snapshot) {
    row.time = state_.time;
    row.diagnostics = evaluation_.diagnostics;
    recorder_.record(row, state_, evaluation_, with_snapshot, meter_.totals());
    const double drift = std::max(std::abs(row.diagnostics.area_drift), std::abs(row.diagnostics.volume_drift));
    progress_.update({state_.step, state_.time, row.dt, drift});
  }

  const Scene& scene_;
  Instruments instruments_;
  Problem problem_;
  Discretisation discretisation_;
  Checkpoint start_;
  WorkMeter meter_;
  State state_;
  RunRecorder recorder_;
  Progress progress_;
  Evaluation evaluation_;
};

}  // namespace

RunOutcome simulate(const RunTask& task, Interruption& interruption) {
  Simulation simulation(task);
  return simulation.run(interruption);
}

}  // namespace vehd
