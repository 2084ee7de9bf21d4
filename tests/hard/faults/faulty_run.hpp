#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tests/app/reference_run.hpp"

/// A command of vehd under a fault such as "kill 17", see shim/fault_shim.cpp; "" for none.
std::vector<std::string> with_fault(const std::string& fault, const std::vector<std::string>& command);

/// A run whose file operations fail or kill it.
struct FaultyRun : ReferenceRun {
  using ReferenceRun::ReferenceRun;

  [[nodiscard]] std::vector<std::string> command_with(const std::string& fault) const;

  struct Work {
    std::int64_t operations = 0, bytes = 0;
  };
  /// File operations and bytes of the run from its start to its end; leaves no files.
  [[nodiscard]] Work count_work() const;

  /// Number of snapshots that the last checkpoint counts; 0 if there is none. Checks the directory: every snapshot is
  /// intact and equals the reference, no counted one is missing, the history is a beginning of the reference's.
  [[nodiscard]] std::int64_t check_files() const;
};

/// A scene with `tolerance` instead of `dt`: the run chooses steps and degrees.
std::string adaptive_scene();
