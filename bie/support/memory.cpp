#include "bie/support/memory.hpp"

#include <malloc.h>
#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace vehd {

void keep_freed_memory() {
  constexpr int kNever = 1 << 30;
  mallopt(M_MMAP_THRESHOLD, kNever);
  mallopt(M_TRIM_THRESHOLD, kNever);
  // Other threads allocate from heaps of 64 MiB, which would be unmapped when empty; this padding keeps them.
  constexpr int kKept = 16 << 20;
  mallopt(M_TOP_PAD, kKept);
}

std::int64_t peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return std::int64_t{usage.ru_maxrss} * 1024;
}

namespace {

/// A line "KEY:  1234 kB" of /proc/self/status, in bytes; 0 if there is none.
std::int64_t status_bytes(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key + ":")) continue;
    std::int64_t kilobytes = 0;
    std::istringstream(line.substr(key.size() + 1)) >> kilobytes;
    return kilobytes * 1024;
  }
  return 0;
}

/// Resets the peak resident size to the present size; false if the system refuses.
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

/// The peak since the last call counts for every open part.
void MemoryMeter::look() {
  const std::int64_t peak = status_bytes("VmHWM");
  for (OpenPart& part : open_) part.peak = std::max(part.peak, peak);
}

void MemoryMeter::begin(const std::string& part) {
  if (!active_) return;
  look();
  malloc_trim(0);
  if (!reset_peak()) return stop();
  const std::int64_t held = status_bytes("VmRSS");
  open_.push_back({part, held, held});
}

void MemoryMeter::end() {
  if (open_.empty()) return;
  look();
  const OpenPart part = open_.back();
  open_.pop_back();
  std::int64_t& peak = peaks_[part.name];
  peak = std::max(peak, part.peak - part.held);
}

}  // namespace vehd
