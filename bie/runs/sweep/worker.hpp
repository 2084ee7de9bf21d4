#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <vector>

#include "bie/runs/sweep/claim.hpp"
#include "bie/runs/sweep/sweep_runs.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// What a worker tells whoever has started it, in memory that both have.
struct WorkerBoard {
  std::atomic<std::int64_t> n_finished;  ///< runs, all that had this board together
  std::atomic<double> run_seconds;       ///< that went into runs, on the clock; the rest is the sweep's own work
  std::atomic<double> share;             ///< of the run in hand that is done
  std::array<char, 512> problem;         ///< why it ended, where that is not plain; ends with a 0
};

/// Why a worker ends.
enum class WorkerEnd {
  nothing_left = 0,  ///< that it could claim
  interrupted,       ///< by a signal; its run can be continued
  lost_claim,        ///< another worker took its run, which another worker may do where this one seemed dead
  cannot_write       ///< the disk is full, say; its run can be continued
};

/// A worker of a sweep: claims one run after the other, each goes from where it is to its end, and leaves result.json.
/// A run that the solver stops, or refuses to begin, has a result that says so.
/// @param order  in which the runs are looked at; each is looked at as often as there may be something to do
/// @param interruption  alive since before the first parallel region
WorkerEnd work_at_sweep(const SweepFile& sweep, const std::vector<SweepRun>& runs,
                        const std::vector<std::size_t>& order, const std::filesystem::path& folder,
                        Interruption& interruption, WorkerBoard& board, ClaimTimes times = {});

}  // namespace vehd
