#pragma once

#include <stdexcept>

namespace vehd {

/// A file of the run could not be written: no permission, disk full, directory gone.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Closed set of what the program returns to the shell.
enum class ExitCode {
  done = 0,
  wrong_input = 1,     ///< wrong input or usage
  internal_error = 2,  ///< a defect of the program
  stopped_early = 3,   ///< and left a checkpoint that can be resumed
  does_not_hold = 4    ///< done, and what was asked does not hold
};

}  // namespace vehd
