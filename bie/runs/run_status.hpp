#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace vehd {

/// Where a run is after a step; times are those of its history.
struct RunStatus {
  std::int64_t step = 0;
  double start_time = 0.0;  ///< of this session
  double time = 0.0;
  double end_time = 0.0;
  double dt = 0.0;
  double drift = 0.0;       ///< larger of area and volume drift
  double seconds = 0.0;     ///< of this session, on the clock
  std::string time_unit{};  ///< symbol; empty where times are dimensionless
  std::string gap{};        ///< smallest one between vesicles with its unit; empty where there is one vesicle
};

/// Told after every step; may be empty.
using TellStatus = std::function<void(const RunStatus&)>;

}  // namespace vehd
