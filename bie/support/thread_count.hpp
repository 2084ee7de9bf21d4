#pragma once

#include <omp.h>

namespace vehd {

/// Largest number of threads that a user may request: OpenMP ends the process if it cannot start one.
constexpr int most_threads = 1024;

/// Sets the number of threads for the scope of this object.
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
