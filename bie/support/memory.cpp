#include "bie/support/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

namespace vehd {

void keep_freed_memory() {
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  // What threads have beside the main one comes in pieces of 64 MiB, which go when they are empty but for this.
  constexpr int kKept = 16 << 20;
  mallopt(M_TOP_PAD, kKept);
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

}  // namespace vehd
