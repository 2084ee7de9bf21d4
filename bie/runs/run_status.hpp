#pragma once

#include <cstdint>
#include <functional>

namespace vehd {

/// Where a run is after a step.
struct RunStatus {
  std::int64_t step = 0;
  double start_time = 0.0;  ///< of this session
  double time = 0.0;
  double end_time = 0.0;
  double dt = 0.0;
  double drift = 0.0;    ///< larger of area and volume drift
  double seconds = 0.0;  ///< of this session
};

/// Told after every step; may be empty.
using TellStatus = std::function<void(const RunStatus&)>;

}  // namespace vehd
