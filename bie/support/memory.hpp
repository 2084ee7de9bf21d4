#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bie/support/instruments.hpp"

namespace vehd {

/// Lets the process keep freed memory for its next allocation. Every step frees and allocates the same tens of
/// megabytes; handing them back to the kernel costs a page fault for every 4 KiB, about a third of an assembly.
void keep_freed_memory();

/// Peak resident memory of this process.
std::int64_t peak_memory_bytes();

/// Peak memory of each part of the work beyond what the process held when the part began, to a page, from the resident
/// size that Linux records. Costs milliseconds per part, so a metered run should not be timed.
class MemoryMeter : public PartObserver {
 public:
  /// Starts metering. Freed memory is returned to the system at the beginning of each part.
  void start() { active_ = true; }
  /// Stops metering.
  void stop() { active_ = false; }

  void begin(const std::string& part) override;
  void end() override;

  /// Bytes of each part so far; empty if the system does not report them.
  [[nodiscard]] const std::map<std::string, std::int64_t>& peaks() const { return peaks_; }

 private:
  struct OpenPart {
    std::string name;
    std::int64_t held, peak;
  };
  void look();

  bool active_ = false;
  std::vector<OpenPart> open_;
  std::map<std::string, std::int64_t> peaks_;
};

}  // namespace vehd
