#pragma once

#include <chrono>
#include <stdexcept>
#include <string>

#include "bie/support/instruments.hpp"

namespace vehd {

/// Work was given up because its time was over.
class OutOfTime : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Ends work once its time is over: instruments that it observes throw OutOfTime where the next part begins.
class Deadline : public PartObserver {
 public:
  /// @param seconds  from now
  explicit Deadline(double seconds) : seconds_(seconds) {}

  /// Negative once it is over.
  [[nodiscard]] double seconds_left() const {
    return seconds_ - std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  void begin(const std::string& part) override {
    if (!(seconds_left() > 0.0)) throw OutOfTime("no time is left for: " + part);
  }
  void end() override {}

 private:
  double seconds_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace vehd
