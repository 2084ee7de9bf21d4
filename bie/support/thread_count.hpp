#pragma once

#include <omp.h>

namespace vehd {

/// That a user may request: OpenMP ends the process where it cannot start one.
constexpr int most_threads = 1024;

/// So many threads in its scope.
class ThreadCount {
 public:
  explicit ThreadCount(int count) { omp_set_num_threads(count); }
  ~ThreadCount() { omp_set_num_threads(before_); }
  ThreadCount(const ThreadCount&) = delete;
  ThreadCount& operator=(const ThreadCount&) = delete;

 private:
  int before_ = omp_get_max_threads();
};

}  // namespace vehd
