#pragma once

#include <chrono>
#include <string>

namespace vehd {

/// What a bench is at, on standard error: one line redrawn in place on a terminal, elsewhere a plain line now and then.
class BenchProgress {
 public:
  /// @param n_tasks  of the bench
  explicit BenchProgress(int n_tasks);
  ~BenchProgress();
  BenchProgress(const BenchProgress&) = delete;
  BenchProgress& operator=(const BenchProgress&) = delete;

  /// The next task begins.
  void next(const std::string& task);
  /// Gives the line back to the results.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  int n_tasks_;
  int n_begun_ = 0;
  bool on_terminal_;
  bool line_open_ = false;
  Clock::time_point last_ = Clock::now();
};

}  // namespace vehd
