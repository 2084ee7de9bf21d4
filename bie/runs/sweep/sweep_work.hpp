#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "bie/runs/sweep/sweep_table.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// Which runs workers compute, and how.
struct SweepTask {
  const SweepPaths& paths;
  const std::vector<SweepRun>& runs;
  int n_workers = 1;
  int n_threads = 1;  ///< threads of each worker
  /// Called often; n_runs counts the runs without a result at the start.
  std::function<void(std::int64_t n_finished, std::int64_t n_runs, double share)> report_progress{};
  std::size_t first = 0;  ///< run that workers try first, then those after it and at last those before it
};

/// Computes a sweep with processes of this machine until they find no run that they can claim. A process that is ended
/// by a signal is replaced. If a run crashes its worker, or its workers are killed repeatedly, for example by a system
/// short of memory, its result says so.
/// @param interruption  created before the first parallel region
/// @return              why workers ended early; empty if they did not
/// @throws OutputError if no process can be started
std::string run_sweep(const SweepTask& task, Interruption& interruption);

/// Progress of a worker, in memory shared with the process that started it; begins with zeros.
struct WorkerBoard {
  std::atomic<std::int64_t> n_finished;  ///< runs finished by all workers that had this board
  std::atomic<double> share;             ///< completed share of the present run
  std::atomic<std::size_t> run;          ///< number of the present run, counted from 1; 0: none
  std::array<char, 512> problem;         ///< why the worker cannot write; ends with a 0
};

/// Why a worker ends; its run can be resumed. A worker that throws exits with ExitCode::internal_error instead.
enum class WorkerEnd { nothing_left = 0, interrupted = 10, cannot_write = 11 };

/// One worker: claims one run after the other, computes each from its present state to its end and writes its result,
/// also if the run stops or is refused.
WorkerEnd work_at_sweep(const SweepTask& task, Interruption& interruption, WorkerBoard& board);

}  // namespace vehd
