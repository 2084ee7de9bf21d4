#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bie/runs/scene_changes.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

/// Work done so far, over all sessions of a run.
struct RunTotals {
  double seconds = 0.0;
  std::map<std::string, std::uint64_t> kernel_evaluations;
  std::map<std::string, double> seconds_of_parts;
  std::map<std::string, std::uint64_t> pair_targets{};  ///< see Instruments
};

/// State from which error bars are continued, see ErrorBars. Rows have the columns of history.csv, without units.
struct CompanionState {
  State state{};                 ///< state of the companion run
  std::int64_t start_order = 0;  ///< its start_order, see Checkpoint
  std::int64_t lost = 0;         ///< 1 once it cannot take a step
  Vector former{};               ///< differences at the last comparison; empty if there was none
  Matrix waiting{};              ///< rows of the history whose errors are not known yet
  std::int64_t bytes = 0;        ///< size of history_error.csv
  std::int64_t checksum = 0;     ///< checksum of these bytes
};

/// The run that a run continues, and the state it started from.
struct Origin {
  std::string run{};  ///< directory of the other run
  State state{};      ///< in the laboratory frame
};

/// Everything that a resumed run needs to continue bit for bit, and the extent of the other files.
struct Checkpoint {
  std::string scene;                 ///< effective scene
  std::vector<SceneChange> changes;  ///< changes that sessions made to it, in the order of time
  std::optional<Origin> origin{};
  /// No vesicles: the run starts with the initial state of the scene.
  State state;
  std::int64_t start_order = 0;  ///< degree of the initial shape, at which frame and symmetry were found
  std::int64_t n_rows = 0;       ///< rows of history.csv; 0: the state itself has no row yet
  std::int64_t history_bytes = 0;
  std::int64_t history_checksum = 0;   ///< checksum of these bytes
  std::int64_t vesicles_bytes = 0;     ///< size of vesicles.csv; 0 with one vesicle
  std::int64_t vesicles_checksum = 0;  ///< checksum of these bytes
  std::int64_t n_snapshots = 0;
  std::int64_t snapshots_checksum = 0;  ///< checksum of the checksums of their seals
  std::int64_t threads = 1;
  RunTotals totals;
  std::optional<CompanionState> companion;  ///< with error bars only
};

/// Writes a checkpoint; an existing file is replaced in one step. @throws OutputError
void write_checkpoint(const std::filesystem::path& path, const Checkpoint& checkpoint);

/// The checkpoint has the schema of another version of vehd.
struct OtherSchemaVersion : InputError {
  using InputError::InputError;
};

/// Reads a checkpoint.
/// @throws InputError if the file is truncated or altered, OtherSchemaVersion
/// Accuracy: exact; a resumed run takes the same steps bit for bit (tests/app/resume_test.cpp)
Checkpoint read_checkpoint(const std::filesystem::path& path);

/// A checkpoint from an HDF5 image whose seal was verified.
/// @throws InputError
Checkpoint checkpoint_of(const std::string& image, const std::string& name);

}  // namespace vehd
