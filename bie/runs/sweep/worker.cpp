#include "bie/runs/sweep/worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bie/runs/session.hpp"
#include "bie/runs/sweep/heartbeat.hpp"
#include "bie/runs/sweep/run_result.hpp"
#include "bie/support/crash_mark.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

/// How it went with one run.
enum class Turn { finished, busy, interrupted, lost };

/// Time on the clock since it was made.
class TurnClock {
 public:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class SweepWorker {
 public:
  SweepWorker(const SweepFile& sweep, const std::vector<SweepRun>& runs, const std::filesystem::path& folder,
              Interruption& interruption, WorkerBoard& board, ClaimTimes times)
      : sweep_(sweep),
        runs_(runs),
        claims_(folder, times),
        interruption_(interruption),
        board_(board),
        heartbeat_(times.beat),
        settled_(runs.size(), false) {}

  WorkerEnd work(const std::vector<std::size_t>& order) {
    for (bool found = true; found;) {
      found = false;
      for (const std::size_t i : order) {
        if (settled_[i]) continue;
        if (interruption_.requested()) return WorkerEnd::interrupted;
        if (!runs_[i].scene || has_result(claims_.runs() / runs_[i].name)) {
          settled_[i] = true;
          continue;
        }
        const auto claim = claims_.take(runs_[i].name);
        if (!claim) continue;
        const Turn turn = take_turn(runs_[i], *claim);
        if (turn == Turn::interrupted) return WorkerEnd::interrupted;
        if (turn == Turn::lost) return WorkerEnd::lost_claim;
        settled_[i] = turn == Turn::finished;
        found = found || settled_[i];
      }
    }
    return WorkerEnd::nothing_left;
  }

 private:
  Turn take_turn(const SweepRun& run, const Claim& claim) {
    const CrashMark mark(claim.file(), claim.crash_stem());
    heartbeat_.watch(claim.file());
    const Turn turn = turn_of(run, claim);
    heartbeat_.watch({});
    board_.share = 0.0;
    return turn;
  }

  Turn turn_of(const SweepRun& run, const Claim& claim) {
    const TurnClock clock;
    try {
      RunResult result = result_of_turn(run, claim);
      // All that the run asks for: what former turns have computed, and of this one set-up, steps and files alike.
      result.seconds += clock.seconds();
      board_.run_seconds = board_.run_seconds + clock.seconds();
      if (heartbeat_.lost()) return Turn::lost;
      write_result(claim.directory(), result);
      claim.finish();
      ++board_.n_finished;
      return Turn::finished;
    } catch (const Interrupted&) {
      board_.run_seconds = board_.run_seconds + clock.seconds();
      if (heartbeat_.lost()) return Turn::lost;
      claim.release();
      return Turn::interrupted;
    } catch (const Busy&) {
      claim.release();
      return Turn::busy;
    } catch (const OutputError&) {
      claim.release();
      throw;
    }
  }

  /// A process that others took for dead is still writing there.
  struct Busy {};

  RunResult result_of_turn(const SweepRun& run, const Claim& claim) {
    require_free(RunPaths{claim.directory()});
    try {
      const RunSession session(*run.scene, {sweep_.scene_file, run.settings}, claim.directory(), true);
      const double before = session.seconds_before();
      if (session.is_complete()) return result_of(session.paths(), session.last_summary(), before);
      const RunOutcome outcome = session.simulate(interruption_, [this](const RunStatus& status) {
        board_.share = status.end_time > 0.0 ? std::clamp(status.time / status.end_time, 0.0, 1.0) : 1.0;
      });
      if (!outcome.completed && !outcome.cannot_step) {
        if (interruption_.requested()) throw Interrupted(outcome.reason);
        throw OutputError(outcome.reason);
      }
      return result_of(session.paths(), session.summarise(outcome), before);
    } catch (const InputError& error) {
      return {"refused", error.what(), 0.0, {}, {}};
    } catch (const ConvergenceError& error) {
      return {"refused", fmt::format("what the scene asks for cannot be computed: {}", error.what()), 0.0, {}, {}};
    } catch (const Interrupted&) {
      throw;
    } catch (const OutputError&) {
      throw;
    } catch (const std::exception& error) {
      return {"crashed", fmt::format("internal error: {}", error.what()), 0.0, {}, {}};
    }
  }

  static void require_free(const RunPaths& paths) {
    try {
      const DirectoryLock lock(paths.lock());
    } catch (const InputError&) {
      throw Busy{};
    }
  }

  const SweepFile& sweep_;
  const std::vector<SweepRun>& runs_;
  Claims claims_;
  Interruption& interruption_;
  WorkerBoard& board_;
  Heartbeat heartbeat_;
  std::vector<bool> settled_;
};

}  // namespace

WorkerEnd work_at_sweep(const SweepFile& sweep, const std::vector<SweepRun>& runs,
                        const std::vector<std::size_t>& order, const std::filesystem::path& folder,
                        Interruption& interruption, WorkerBoard& board, ClaimTimes times) {
  try {
    return SweepWorker(sweep, runs, folder, interruption, board, times).work(order);
  } catch (const OutputError& error) {
    *fmt::format_to_n(board.problem.data(), board.problem.size() - 1, "{}", error.what()).out = '\0';
    return WorkerEnd::cannot_write;
  }
}

}  // namespace vehd
