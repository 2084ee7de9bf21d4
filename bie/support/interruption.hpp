#pragma once

#include <csignal>
#include <stdexcept>

namespace vehd {

/// A signal has ended work that is more than one run, or a trial. Exit code 3.
class Interrupted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// While alive, SIGINT, SIGTERM and SIGUSR1 wait until `requested` looks for them, so that a step is never torn.
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
