#pragma once

#include <functional>
#include <optional>
#include <string>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/runs/run_status.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// How a run ended; `reason` says why it did not reach its end.
struct RunOutcome {
  bool completed = false;
  std::string reason;
  bool cannot_step = false;  ///< no step is acceptable: continued unchanged, the run would stop there again
};

/// What a session of a run is to do, and whom it tells.
struct RunTask {
  const Scene& scene;
  const RunPaths& paths;
  const std::optional<Checkpoint>& checkpoint;  ///< absent: a new run; otherwise see `continued`
  TellStatus tell{};                            ///< called when the start and each step are in the files
  std::function<void()> after_step{};           ///< called when a step is in the files; may be empty
};

/// Simulates from the initial state or the checkpoint to the end of the scene, with all files of the run up to date
/// after every accepted step. Solver failures and full disks end it early; they are not exceptions.
/// @throws InputError, ConvergenceError if the run cannot be started; no file of a run exists then
RunOutcome simulate(const RunTask& task, Interruption& interruption);

}  // namespace vehd
