#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "bie/files/run_file.hpp"
#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/runs/simulation.hpp"
#include "bie/runs/snapshot_store.hpp"
#include "bie/sphere/transform.hpp"
#include "bie/stepping/evaluation/lab_frame_output.hpp"

namespace vehd {

/// Files that are written anew as a whole or opened and closed, which costs more than a short step does, may be behind
/// by this.
constexpr std::chrono::milliseconds longest_lag_of_files{500};

/// Keeps the files of a run in step with each other: history row first, snapshot second, checkpoint last, so that
/// the checkpoint never counts what is not there. It, run.h5 and run.xdmf may lag: steps that a kill leaves uncounted
/// are made again, and the next session lists what the last one could not.
class RunRecorder {
 public:
  /// @param start  the checkpoint to continue from; that of a new run has no rows. Its scene is the effective one, and
  ///               it has a companion where there are error bars
  /// @param settings  with the degree of the files, which must not be less than that of files that exist
  /// @param frame  of the states to come: the checkpoint keeps them as they are, all other files show the laboratory
  /// @param units  of the history: where it goes on, those that it began with
  /// @param kind   of the history
  /// @param wall   of the laboratory
  /// @param checkpoint_lag  by which the checkpoint may be behind the rows until the session ends
  RunRecorder(const RunPaths& paths, const NumericalSettings& settings, const Frame& frame, const Checkpoint& start,
              const OutputUnits& units, HistoryKind kind, std::optional<Wall> wall,
              std::chrono::milliseconds checkpoint_lag);

  /// Records one accepted state: moments within its step, and then the state, which has two sides where the forcing
  /// jumps. Rows say themselves whether there is a snapshot of them. A kill leaves either none or all of the rows of a
  /// step to a resumed run.
  /// @param state  with which a run goes on
  void record(const State& state, const std::vector<RecordedSide>& sides, const RunTotals& totals);

  /// Records rows of history_error.csv, [n_columns] each, and the state of the companion; to be called before record()
  /// of the same step.
  void record_errors(const std::vector<Vector>& rows, CompanionState companion);

  /// Adds a snapshot of the state recorded last unless it has one.
  void keep_last_state(const Fields& fields);

  /// Brings every file up to date, with the work that a session has done after its last row.
  void end_session(const RunTotals& totals);

  [[nodiscard]] std::int64_t n_rows() const { return last_.n_rows; }
  /// Marks the files as final.
  void finish() { snapshots_.finish(); }

 private:
  void write_snapshots();
  void save(const RunTotals& totals);
  void write_xdmf();
  /// Lists a snapshot. @param x  coefficients of every vesicle in the laboratory
  void list_in_xdmf(double time, const std::vector<Matrix>& x);

  const RunPaths& paths_;
  SiUnits si_units_;
  SphereTransform output_;  ///< degree and grid of the files
  LabFrameOutput lab_frame_;
  Checkpoint last_;
  struct Snapshot {
    State state;
    Fields fields;
  };
  SnapshotStore snapshots_;
  std::vector<Snapshot> waiting_;  ///< to be written
  HistoryFile history_;
  std::optional<HistoryFile> vesicles_;  ///< of each, where there are several
  std::optional<HistoryFile> errors_;    ///< of the history, where they are asked for
  XdmfSeries xdmf_;
  std::optional<Wall> wall_;
  std::chrono::milliseconds checkpoint_lag_;
  std::optional<std::chrono::steady_clock::time_point> snapshots_written_, xdmf_written_, saved_;
};

}  // namespace vehd
