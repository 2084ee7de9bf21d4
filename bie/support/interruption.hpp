#pragma once

#include <csignal>
#include <stdexcept>

namespace vehd {

/// A signal ended a command that consists of several runs, or a trial run. Exit code 3.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While an object exists, SIGINT, SIGTERM and SIGUSR1 stay pending until `requested` polls them, so no step is torn.
/// Threads started later inherit this; create it before the first parallel region.
class Interruption {
 public:
  Interruption();
  ~Interruption();
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;

  /// Whether one of the signals has arrived since construction.
  [[nodiscard]] bool requested();

 private:
  sigset_t signals_{};
  sigset_t former_mask_{};
  bool requested_ = false;
};

}  // namespace vehd
