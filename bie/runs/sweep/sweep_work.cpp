#include "bie/runs/sweep/sweep_work.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <boost/interprocess/anonymous_shared_memory.hpp>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <thread>

#include "bie/runs/session.hpp"
#include "bie/runs/sweep/claim.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/thread_count.hpp"
#include "bie/support/worker_pool.hpp"

namespace vehd {
namespace {

/// Computes a run that this process has claimed. @return nullopt if it was interrupted @throws OutputError
std::optional<RunResult> compute(const SweepTask& task, const SweepRun& run, Interruption& interruption,
                                 WorkerBoard& board) {
  const auto seconds = [start = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  try {
    const RunSession session(*run.scene, run.source, task.paths.run(run), true, {}, true);
    nlohmann::json summary = session.is_complete() ? session.last_summary() : nlohmann::json();
    if (!session.is_complete()) {
      const auto show = [&board](const RunStatus& status) {
        board.share = status.end_time > 0.0 ? std::clamp(status.time / status.end_time, 0.0, 1.0) : 1.0;
      };
      const RunOutcome outcome = simulate(session.task(show, longest_lag_of_files), interruption);
      if (!outcome.completed && !outcome.cannot_step) {
        if (interruption.requested()) return std::nullopt;
        throw OutputError(outcome.reason);
      }
      summary = session.summarise(outcome);
    }
    RunResult result = result_of(session.paths(), summary);
    // Computing time of earlier sessions; of this session also set-up and files.
    result.seconds = session.seconds_before() + seconds();
    return result;
  } catch (const InputError& error) {
    return RunResult{"refused", error.what(), seconds()};
  } catch (const ConvergenceError& error) {
    const std::string reason = fmt::format("the scene cannot be computed: {}", error.what());
    return RunResult{"refused", reason, seconds()};
  } catch (const OutputError&) {
    throw;
  } catch (const std::exception& error) {
    return RunResult{"crashed", fmt::format("internal error: {}", error.what()), seconds()};
  }
}

/// Claims a run and computes it. @return whether it has a result now
bool finish_run(const SweepTask& task, std::size_t number, Interruption& interruption, WorkerBoard& board) {
  const SweepRun& run = task.runs[number];
  // Set before the claim, so that a worker killed while it claims a run is attributed to this run.
  board.run = number + 1;
  const auto claim = Claim::take(task.paths.run(run));
  // Another worker may have just finished it.
  const bool is_done = claim && has_result(task.paths.run(run));
  if (!claim || is_done) {
    board.run = 0;
    return is_done;
  }
  const std::optional<RunResult> result = compute(task, run, interruption, board);
  board.share = 0.0;
  const bool is_finished = result && !claim->is_lost();
  if (is_finished) {
    write_result(task.paths.run(run), *result);
    ++board.n_finished;
  }
  board.run = 0;
  return is_finished;
}

WorkerEnd claim_runs(const SweepTask& task, Interruption& interruption, WorkerBoard& board) {
  std::vector<bool> is_settled(task.runs.size(), false);
  for (bool found = true; found;) {
    found = false;
    for (std::size_t k = 0; k < task.runs.size(); ++k) {
      const std::size_t i = (task.first + k) % task.runs.size();
      if (is_settled[i]) continue;
      if (interruption.requested()) return WorkerEnd::interrupted;
      is_settled[i] = !task.runs[i].scene || has_result(task.paths.run(task.runs[i]));
      if (is_settled[i]) continue;
      is_settled[i] = finish_run(task, i, interruption, board);
      found = found || is_settled[i];
    }
  }
  return WorkerEnd::nothing_left;
}

/// The worker processes of this machine, and the response to their ends.
class Workers {
 public:
  Workers(const SweepTask& task, Interruption& interruption)
      : task_(task),
        interruption_(interruption),
        memory_(boost::interprocess::anonymous_shared_memory(sizeof(WorkerBoard) * n_workers())),
        boards_(static_cast<WorkerBoard*>(memory_.get_address()), n_workers()),
        pool_([this](int number) { return work(number); }) {
    std::uninitialized_value_construct(boards_.begin(), boards_.end());
    std::set<std::string> names;
    for (const SweepRun& run : task.runs) {
      if (run.scene && !has_result(task.paths.run(run))) names.insert(run.name);
    }
    n_runs_ = std::ssize(names);
  }

  std::string run() {
    for (int i = 0; i < task_.n_workers; ++i) pool_.start(i);
    while (pool_.n_working() > 0) {
      while (const auto end = pool_.next_end()) handle_end(*end);
      if (!problem_ && interruption_.requested()) stop("a signal came");
      report_progress();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return problem_.value_or("");
  }

 private:
  [[nodiscard]] std::size_t n_workers() const { return static_cast<std::size_t>(task_.n_workers); }

  /// Runs in a copy of this process.
  int work(int number) {
    const ThreadCount threads(task_.n_threads);
    return static_cast<int>(work_at_sweep(task_, interruption_, boards_[static_cast<std::size_t>(number)]));
  }

  void handle_end(const WorkerPool::End& end) {
    WorkerBoard& board = boards_[static_cast<std::size_t>(end.number)];
    board.share = 0.0;
    const std::size_t run = board.run.exchange(0);
    if (end.signal != 0) {
      count_kill(run, end.signal);
    } else if (end.exit_code == static_cast<int>(WorkerEnd::cannot_write)) {
      stop(board.problem.data());
    } else if (end.exit_code == static_cast<int>(WorkerEnd::nothing_left)) {
      return;
    } else if (end.exit_code != static_cast<int>(WorkerEnd::interrupted)) {
      stop("a worker ended by an internal error");
    } else if (interruption_.requested()) {
      stop("a signal came");
    }
    // Any other interruption was meant for this worker only.
    if (!problem_) pool_.start(end.number);
  }

  /// Counts a worker that was ended by a signal. If another worker has resumed its run meanwhile, the result of that
  /// worker replaces this one.
  /// @param run  counted from 1; 0: the worker had none
  void count_kill(std::size_t run, int signal) {
    constexpr int most_kills = 20;
    const int kills = ++n_kills_[run];
    const bool is_crash = std::set{SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT}.contains(signal);
    if (!is_crash && kills <= most_kills) return;
    const std::string reason = is_crash
                                   ? fmt::format("its worker was ended by signal {} ({})", signal, ::strsignal(signal))
                                   : fmt::format("{} workers were killed while computing it", kills);
    if (run == 0) return stop("without a run: " + reason);
    const std::filesystem::path directory = task_.paths.run(task_.runs[run - 1]);
    if (!has_result(directory)) write_result(directory, {"crashed", reason});
  }

  void stop(const std::string& problem) {
    if (!problem_) problem_ = problem;
    pool_.stop();
  }

  void report_progress() const {
    if (!task_.report_progress) return;
    std::int64_t n_finished = 0;
    double share = 0.0;
    for (const WorkerBoard& board : boards_) {
      n_finished += board.n_finished;
      share += board.share;
    }
    share += static_cast<double>(n_finished);
    task_.report_progress(n_finished, n_runs_, n_runs_ == 0 ? 1.0 : share / static_cast<double>(n_runs_));
  }

  const SweepTask& task_;
  Interruption& interruption_;
  boost::interprocess::mapped_region memory_;
  std::span<WorkerBoard> boards_;
  WorkerPool pool_;
  std::optional<std::string> problem_;  ///< why workers end early
  std::map<std::size_t, int> n_kills_;  ///< for each run
  std::int64_t n_runs_ = 0;             ///< runs without a result at the start
};

}  // namespace

std::string run_sweep(const SweepTask& task, Interruption& interruption) { return Workers(task, interruption).run(); }

WorkerEnd work_at_sweep(const SweepTask& task, Interruption& interruption, WorkerBoard& board) {
  try {
    return claim_runs(task, interruption, board);
  } catch (const std::runtime_error& error) {
    *fmt::format_to_n(board.problem.data(), board.problem.size() - 1, "{}", error.what()).out = '\0';
    return WorkerEnd::cannot_write;
  }
}

}  // namespace vehd
