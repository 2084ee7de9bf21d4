#include "bie/support/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

namespace vehd {

void keep_freed_memory() {
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  // One arena: only the main one may grow past 64 MiB.
  mallopt(M_ARENA_MAX, 1);
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace vehd
