#pragma once

#include <cstdint>

namespace vehd {

/// Lets the process keep freed memory for its next allocation. Every step frees and allocates the same tens of
/// megabytes; handing them back to the kernel costs a page fault for every 4 KiB, about a third of an assembly.
void keep_freed_memory();

/// Most memory that this process has held.
std::int64_t peak_memory_bytes();

}  // namespace vehd
