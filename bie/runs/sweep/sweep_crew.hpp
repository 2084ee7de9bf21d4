#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "bie/runs/sweep/sweep_table.hpp"
#include "bie/runs/sweep/worker.hpp"

namespace vehd {

/// How far the workers of this machine have come.
struct CrewStatus {
  std::int64_t n_runs = 0;
  std::int64_t n_finished = 0;  ///< with what was there before
  double share = 0.0;           ///< of all runs, those in hand in part
  double start_share = 0.0;     ///< when this crew began
  double seconds = 0.0;         ///< since then
};

/// What a crew is to do.
struct CrewTask {
  const SweepPaths& paths;
  const SweepFile& sweep;
  const std::vector<SweepRun>& runs;
  std::vector<std::size_t> order;  ///< in which workers look at the runs
  int n_workers = 1;
  int n_threads = 1;  ///< of each worker
  std::function<void(const CrewStatus&)> tell{};
};

/// How a crew has ended.
struct CrewOutcome {
  bool interrupted = false;
  std::string problem;          ///< why workers have ended early; empty if they have not
  double worker_seconds = 0.0;  ///< on the clock, of all workers from start to end
  double run_seconds = 0.0;     ///< of these what went into runs
};

/// Workers on this machine until nothing is left that they could claim. One that ends by a signal is replaced: by a
/// crash of its run, of which there is a row then, or from outside, and then the run goes on.
/// @throws OutputError if no process can be started
CrewOutcome work_as_crew(const CrewTask& task, Interruption& interruption);

}  // namespace vehd
