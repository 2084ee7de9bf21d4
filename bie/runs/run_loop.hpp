#pragma once

#include <chrono>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/error_bars.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/runs/run_recorder.hpp"
#include "bie/runs/run_status.hpp"
#include "bie/runs/simulation.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/interruption.hpp"
#include "bie/support/ranks/ranks.hpp"

namespace vehd {

/// How a run ended; `reason` says why it did not reach its end.
struct RunOutcome {
  bool completed = false;
  std::string reason;
  bool cannot_step = false;  ///< no step is acceptable: resumed without changes, the run would stop there again
};

/// Task of a session of a run, with its callbacks.
struct RunTask {
  const Scene& scene;
  const RunPaths& paths;
  const std::optional<Checkpoint>& checkpoint;  ///< absent: a new run; otherwise see `continued`
  OnStatus on_status{};                         ///< called when the start or a step is in the files
  Ranks ranks{};                                ///< ranks that run it together; the first one writes the files
  std::chrono::milliseconds checkpoint_lag{0};  ///< how far the checkpoint may lag behind the steps
};

/// A simulation with its files, which are up to date after every accepted step except for the lag of the checkpoint.
/// All calls are collective.
class RecordedRun {
 public:
  /// @param task  its references must outlive the run
  /// @throws InputError, ConvergenceError if the run cannot be started; no file of a run exists then
  explicit RecordedRun(const RunTask& task);

  /// The simulation; only this run may step it.
  [[nodiscard]] Simulation& simulation() { return simulation_; }
  [[nodiscard]] const Simulation& simulation() const { return simulation_; }
  /// Solves everything at the start. @throws ConvergenceError, OutputError
  void start();
  /// Takes one accepted step. @throws ConvergenceError, OutputError
  void step();
  /// Adds a snapshot of the last state unless there is one, and brings all files up to date. @throws OutputError
  void snapshot();
  /// Outcome of a run whose step has thrown this error. Adds a snapshot of the last state.
  [[nodiscard]] RunOutcome failed(const ConvergenceError& error);
  /// Adds a snapshot of the last state unless there is one.
  void keep_last_state();
  /// Brings all files up to date. @throws OutputError
  void end(const RunOutcome& outcome);

 private:
  void record(std::vector<Vector> errors);
  [[nodiscard]] std::vector<Vector> errors_until(bool end);
  void record_errors(const std::vector<Vector>& errors);
  [[nodiscard]] std::future<std::vector<Vector>> following();

  Simulation simulation_;
  std::unique_ptr<ErrorBars> error_bars_;  ///< null unless requested
  Ranks ranks_;
  std::optional<RunRecorder> recorder_;  ///< on the first rank only
  bool is_recorded_;                     ///< whether the files have the state that the run starts from
  OnStatus on_status_;
};

/// Simulates from the initial state or the checkpoint to the end of the scene. All files of the run are up to date at
/// the end of the session. Solver failures and full disks end it early; they are not exceptions.
/// @throws InputError, ConvergenceError if the run cannot be started; no file of a run exists then
RunOutcome simulate(const RunTask& task, Interruption& interruption);

}  // namespace vehd
