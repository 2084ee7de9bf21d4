#pragma once

#include <stdexcept>

namespace vehd {

/// A file of the run could not be written: no permission, disk full, directory gone.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Closed set of what the program returns to the shell.
enum class ExitCode { done = 0, wrong_input = 1, internal_error = 2, stopped_early = 3 };

}  // namespace vehd
