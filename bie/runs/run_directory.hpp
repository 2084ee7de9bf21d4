#pragma once

#include <filesystem>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

/// Where the files of one run are.
struct RunPaths {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path history() const { return directory / "history.csv"; }
  /// Estimated errors of the history.
  [[nodiscard]] std::filesystem::path history_error() const { return directory / "history_error.csv"; }
  /// Rows of each vesicle; only with several vesicles.
  [[nodiscard]] std::filesystem::path vesicles() const { return directory / "vesicles.csv"; }
  [[nodiscard]] std::filesystem::path snapshots() const { return directory / "run.h5"; }
  [[nodiscard]] std::filesystem::path xdmf() const { return directory / "run.xdmf"; }
  [[nodiscard]] std::filesystem::path summary() const { return directory / "summary.json"; }
  [[nodiscard]] std::filesystem::path scene() const { return directory / "scene.toml"; }
  [[nodiscard]] std::filesystem::path checkpoint() const { return directory / "checkpoint.h5"; }
  [[nodiscard]] std::filesystem::path lock() const { return directory / ".lock"; }
  [[nodiscard]] std::filesystem::path plots() const { return directory / "plots"; }
  [[nodiscard]] std::filesystem::path report() const { return directory / "report.html"; }
};

/// Another process has the lock of a run directory.
struct DirectoryBusy : InputError {
  using InputError::InputError;
};

/// The file system of a run directory does not support locks.
struct NoLocks : OutputError {
  using OutputError::OutputError;
};

/// Exclusive use of a run directory until destruction; a killed process releases it as well.
class DirectoryLock {
 public:
  /// @throws DirectoryBusy, NoLocks, InputError if the directory cannot be written
  explicit DirectoryLock(const std::filesystem::path& lock_file);
  ~DirectoryLock();
  DirectoryLock(const DirectoryLock&) = delete;
  DirectoryLock& operator=(const DirectoryLock&) = delete;

 private:
  int descriptor_ = -1;
};

/// Refuses a directory that holds files of a run, unless they can be resumed and `resume` is true: files of an earlier
/// run are never overwritten. Refuses directories of sweeps and fits. @throws InputError
/// @return whether there is a run to resume
bool admit_run(const RunPaths& paths, bool resume);

}  // namespace vehd
