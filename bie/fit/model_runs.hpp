#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "bie/fit/experiment.hpp"
#include "bie/fit/prediction.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/runs/sweep/sweep_runs.hpp"
#include "bie/support/interruption.hpp"

namespace vehd {

/// How runs are computed.
struct RunWork {
  std::filesystem::path directory;  ///< the runs are below it
  int n_workers = 1;                ///< processes at a time
  int n_threads = 1;                ///< of each process
  /// Progress; called often.
  std::function<void(std::int64_t n_finished, std::int64_t n_runs, double share)> report_progress{};
};

/// The model of experiments: runs of their scenes, each in a directory named by a hash of its effective scene. Finished
/// runs are not computed again and interrupted ones are continued.
class ModelRuns {
 public:
  /// Locks the directory until destruction.
  /// @param experiments, interruption  must outlive it; the latter must exist before the first parallel region
  /// @throws DirectoryBusy if another process holds the lock; OutputError
  ModelRuns(const std::vector<Experiment>& experiments, RunWork work, Interruption& interruption);

  /// Predictions for several points at once; all their runs are computed in parallel.
  /// @param points  settings "table.key=value" of each point
  /// @throws Interrupted, OutputError
  [[nodiscard]] std::vector<Prediction> predict(const std::vector<std::vector<std::string>>& points) const;

  /// Distinct verdicts of the runs of one experiment at a point that was predicted.
  [[nodiscard]] std::vector<std::string> verdicts(const Experiment& experiment,
                                                  const std::vector<std::string>& point) const;

 private:
  [[nodiscard]] SweepRun run_of(const Experiment& experiment, const DataOfRun& data,
                                const std::vector<std::string>& point) const;
  void compute(const std::vector<SweepRun>& runs) const;

  const std::vector<Experiment>& experiments_;
  RunWork work_;
  std::unique_ptr<DirectoryLock> lock_;
  Interruption& interruption_;
};

}  // namespace vehd
