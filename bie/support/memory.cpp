#include "bie/support/memory.hpp"

#include <malloc.h>

namespace vehd {

void keep_freed_memory() {
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  // One arena: only the main one may grow past 64 MiB.
  mallopt(M_ARENA_MAX, 1);
}

}  // namespace vehd
