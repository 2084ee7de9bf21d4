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

/// State from which error bars continue, see ErrorBars. Rows have the columns of history.csv, without units.
struct CompanionState {
  State state{};                 ///< of the companion
  std::int64_t start_order = 0;  ///< of it, see Checkpoint
  std::int64_t lost = 0;         ///< 1 where it cannot take a step
  Vector former{};               ///< differences at the last comparison; empty: there was none
  Matrix waiting{};              ///< rows of the history of which no error is known yet
  std::int64_t bytes = 0;        ///< of history_error.csv
  std::int64_t checksum = 0;     ///< of these bytes
};

/// Where a run continues another one.
struct Origin {
  std::string run{};  ///< directory of the other one
  State state{};      ///< in the laboratory
};

/// Everything that a resumed run needs to continue bit for bit, and how far the other files had got.
struct Checkpoint {
  std::string scene;                 ///< effective scene
  std::vector<SceneChange> changes;  ///< that sessions have made to it, in the order of time
  std::optional<Origin> origin{};
  /// Empty position: the run starts with the initial state of the scene.
  State state;
  std::int64_t start_order = 0;  ///< degree of the initial shape, in which frame and symmetry were found
  std::int64_t n_rows = 0;       ///< rows of history.csv; 0: the state itself is not written yet
  std::int64_t history_bytes = 0;
  std::int64_t history_checksum = 0;   ///< of these bytes
  std::int64_t vesicles_bytes = 0;     ///< of vesicles.csv, likewise; 0 of one vesicle
  std::int64_t vesicles_checksum = 0;  ///< of these bytes
  std::int64_t n_snapshots = 0;
  std::int64_t snapshots_checksum = 0;  ///< of the checksums of their seals
  std::int64_t threads = 1;
  RunTotals totals;
  std::optional<CompanionState> companion;  ///< of a run with error bars
};

/// Replaces the file in one step. @throws OutputError
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
