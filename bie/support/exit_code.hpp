#pragma once

namespace vehd {

/// Exit codes of a program.
enum class ExitCode {
  done = 0,
  wrong_input = 1,     ///< wrong input or usage
  internal_error = 2,  ///< a defect of the program
  stopped_early = 3,   ///< for example by a signal or a full disk; a run leaves a checkpoint to resume from
  check_failed = 4     ///< done, check failed
};

}  // namespace vehd
