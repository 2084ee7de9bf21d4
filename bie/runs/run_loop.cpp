#include "bie/runs/run_loop.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <vector>

#include "bie/runs/resumption.hpp"
#include "bie/runs/run_recorder.hpp"
#include "bie/runs/run_units.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

/// Work of this session on top of that of former ones.
class WorkMeter {
 public:
  WorkMeter(RunTotals before, const Instruments& instruments) : before_(std::move(before)), instruments_(instruments) {}

  /// Of this session.
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  [[nodiscard]] RunTotals totals() const {
    RunTotals totals = before_;
    totals.seconds += seconds();
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
        start_(task.checkpoint.value_or(Checkpoint{})),
        units_(start_.history_bytes > 0 ? units_of_history(task.paths.history(), task.scene.units)
                                        : OutputUnits(task.scene)),
        time_unit_(units_.of("time")),
        problem_(problem_of(task.scene, start_order())),
        events_(events_of(task.scene)),
        evolution_(evolution()),
        meter_(start_.totals, instruments_),
        recorder_(task.paths, settings_of_files(task.paths), problem_.frame, updated(start_), units_),
        after_step_(task.after_step),
        tell_(task.tell),
        start_time_(evolution_.state().time) {}

  RunOutcome run(Interruption& interruption) {
    RunOutcome outcome;
    try {
      outcome = advance_to_end(interruption);
      recorder_.end_session(meter_.totals());
      if (outcome.completed) recorder_.finish();
    } catch (const OutputError& error) {
      outcome = {.completed = false, .reason = error.what()};
    }
    return outcome;
  }

 private:
  [[nodiscard]] bool goes_on() const { return !start_.state.vesicles.empty(); }

  [[nodiscard]] int start_order() const {
    return goes_on() ? static_cast<int>(start_.start_order) : scene_.numerics.order;
  }

  Evolution evolution() {
    EvolutionSetup setup = setup_of(problem_);
    setup.time_text = [unit = time_unit_](double time) { return unit.text_of(time); };
    if (goes_on()) return {std::move(setup), start_.state, instruments_};
    return {std::move(setup), problem_.start, instruments_};
  }

  [[nodiscard]] NumericalSettings settings_of_files(const RunPaths& paths) const {
    NumericalSettings settings = problem_.settings;
    settings.order = order_of_files(scene_, start_, paths);
    return settings;
  }

  /// The numerics, the end and the snapshot times may differ from those of the former session.
  [[nodiscard]] Checkpoint updated(Checkpoint checkpoint) const {
    checkpoint.scene = effective_scene(scene_);
    checkpoint.state = evolution_.state();
    checkpoint.start_order = start_order();
    checkpoint.threads = omp_get_max_threads();
    return checkpoint;
  }

  RunOutcome advance_to_end(Interruption& interruption) {
    try {
      start();
      while (evolution_.state().time < scene_.numerics.end_time) {
        if (interruption.requested()) {
          const std::string now = time_unit_.text_of(evolution_.state().time);
          return {.completed = false, .reason = fmt::format("a signal came at time {}", now)};
        }
        record(evolution_.step(events_));
        if (after_step_) after_step_();
      }
      return {.completed = true, .reason = {}};
    } catch (const ConvergenceError& error) {
      recorder_.keep_last_state(evolution_.evaluation().fields);
      return {.completed = false, .reason = error.what(), .cannot_step = true};
    }
  }

  void start() {
    evolution_.evaluate_start();
    if (recorder_.n_rows() > 0) return;
    StepAttempt none;
    none.iterations_flow = evolution_.evaluation().iterations_flow;
    none.iterations_electric = evolution_.evaluation().iterations_electric;
    none.at_snapshot = true;
    record(none);
  }

  [[nodiscard]] RecordedSide side_of(const State& state, const Evaluation& evaluation, const SmallestGap& gap,
                                     const StepAttempt& step) const {
    std::vector<int> orders;
    for (const VesicleState& vesicle : state.vesicles) orders.push_back(order_of(vesicle.position.rows()));
    const int order = *std::ranges::max_element(orders);
    return {{state.time, step, evaluation.diagnostics, order, evolution_.truncation(state), gap, std::move(orders)},
            state,
            evaluation.fields};
  }

  [[nodiscard]] std::vector<RecordedSide> sides_of(const StepAttempt& step) const {
    std::vector<RecordedSide> sides;
    for (const Evolution::Moment& moment : evolution_.passed()) {
      StepAttempt within;
      within.at_snapshot = true;
      within.iterations_flow = moment.evaluation.iterations_flow;
      within.iterations_electric = moment.evaluation.iterations_electric;
      sides.push_back(side_of(moment.state, moment.evaluation, moment.gap, within));
    }
    const State& state = evolution_.state();
    const Evaluation& now = evolution_.evaluation();
    const std::optional<Evaluation>& before = evolution_.before_jump();
    if (!before) {
      sides.push_back(side_of(state, now, evolution_.gap(), step));
      return sides;
    }
    StepAttempt arrival = step;
    arrival.at_snapshot = false;
    StepAttempt jump;
    jump.at_snapshot = step.at_snapshot;
    jump.iterations_flow = now.iterations_flow;
    jump.iterations_electric = now.iterations_electric;
    sides.push_back(side_of(state, *before, evolution_.gap(), arrival));
    sides.push_back(side_of(state, now, evolution_.gap(), jump));
    return sides;
  }

  void record(const StepAttempt& step) {
    const State& state = evolution_.state();
    recorder_.record(state, sides_of(step), meter_.totals());
    if (!tell_) return;
    double drift = 0.0;
    for (const VesicleDiagnostics& vesicle : evolution_.evaluation().diagnostics.vesicles) {
      drift = std::max({drift, std::abs(vesicle.area_drift), std::abs(vesicle.volume_drift)});
    }
    const auto shown = [&](double time) { return time * time_unit_.factor; };
    tell_({state.step, shown(start_time_), shown(state.time), shown(scene_.numerics.end_time), shown(step.dt), drift,
           meter_.seconds(), time_unit_.symbol, gap_text()});
  }

  /// As the history shows it; empty of a single vesicle.
  [[nodiscard]] std::string gap_text() const {
    const double gap = evolution_.gap().distance;
    if (!std::isfinite(gap)) return {};
    const OutputUnit unit = units_.of("length");
    return fmt::format("{:.3g}{}{}", gap * unit.factor, unit.is_si() ? " " : "", unit.symbol);
  }

  const Scene& scene_;
  Instruments instruments_;
  Checkpoint start_;
  OutputUnits units_;
  OutputUnit time_unit_;
  Problem problem_;
  EventTimes events_;
  Evolution evolution_;
  WorkMeter meter_;
  RunRecorder recorder_;
  const std::function<void()>& after_step_;
  const TellStatus& tell_;
  double start_time_;
};

}  // namespace

RunOutcome simulate(const RunTask& task, Interruption& interruption) {
  Simulation simulation(task);
  return simulation.run(interruption);
}

}  // namespace vehd
