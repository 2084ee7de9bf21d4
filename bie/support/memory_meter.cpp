#include "bie/support/memory_meter.hpp"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace vehd {
namespace {

/// A line "KEY:  1234 kB" of /proc/self/status, in bytes; 0 where there is none.
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

/// Lets the largest resident size start again from the present one.
bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

/// Every open part has seen the peak since the last look.
void MemoryMeter::look() {
  const std::int64_t peak = status_bytes("VmHWM");
  for (OpenPart& part : open_) part.peak = std::max(part.peak, peak);
}

void MemoryMeter::begin(const std::string& part) {
  if (!active_) return;
  look();
  malloc_trim(0);
  if (!forget_peak()) return stop();
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
