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

/// Largest lag of files that are rewritten as a whole, or opened and closed, which costs more than a short step does.
constexpr std::chrono::milliseconds longest_lag_of_files{500};

/// Keeps the files of a run consistent: history row first, snapshot second, checkpoint last, so that the checkpoint
/// never counts missing data. The checkpoint, run.h5 and run.xdmf may lag: steps that were not counted at a kill are
/// repeated, and the next session lists the snapshots that the last one did not.
class RunRecorder {
 public:
  /// @param start  checkpoint to continue from; that of a new run has no rows. Its scene is the effective one, and it
  ///               has a companion if there are error bars
  /// @param settings  with the degree of the files, which must not be less than that of existing files
  /// @param frame  frame of the states: the checkpoint stores them unchanged, all other files show the laboratory frame
  /// @param units  units of the history; if it is continued, those that it began with
  /// @param kind   kind of the history
  /// @param wall   in the laboratory frame
  /// @param checkpoint_lag  how far the checkpoint may lag behind the rows until the session ends
  RunRecorder(const RunPaths& paths, const NumericalSettings& settings, const Frame& frame, const Checkpoint& start,
              const OutputUnits& units, HistoryKind kind, std::optional<Wall> wall,
              std::chrono::milliseconds checkpoint_lag);

  /// Records one accepted step: the snapshots within it, then its final state, which has two rows where the forcing
  /// jumps. Each row states whether it has a snapshot. After a kill, a resumed run finds either none or all of the rows
  /// of a step.
  /// @param state  state from which a run resumes
  void record(const State& state, const std::vector<RecordedSide>& sides, const RunTotals& totals);

  /// Records rows of history_error.csv, [n_columns] each, and the state of the companion; to be called before record()
  /// of the same step.
  void record_errors(const std::vector<Vector>& rows, CompanionState companion);

  /// Adds a snapshot of the last recorded state unless there is one.
  void keep_last_state(const Fields& fields);

  /// Brings every file up to date, including the work that the session has done since its last row.
  void end_session(const RunTotals& totals);

  /// Marks the files as final.
  void finish() { snapshots_.finish(); }

 private:
  void write_snapshots();
  void save(const RunTotals& totals);
  void write_xdmf();
  /// Lists a snapshot. @param x  coefficients of each vesicle in the laboratory frame
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
  std::vector<Snapshot> waiting_;  ///< not written yet
  HistoryFile history_;
  std::optional<HistoryFile> vesicles_;  ///< vesicles.csv, with several vesicles
  std::optional<HistoryFile> errors_;    ///< history_error.csv, with error bars
  XdmfSeries xdmf_;
  std::optional<Wall> wall_;
  std::chrono::milliseconds checkpoint_lag_;
  std::optional<std::chrono::steady_clock::time_point> snapshots_written_, xdmf_written_, saved_;
};

}  // namespace vehd
