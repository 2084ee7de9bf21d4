#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace vehd {

/// Progress of a run after a step; times are in the unit of its history.
struct RunStatus {
  std::int64_t step = 0;
  double start_time = 0.0;  ///< start of this session
  double time = 0.0;
  double end_time = 0.0;
  double dt = 0.0;
  double drift = 0.0;       ///< larger of area and volume drift
  double seconds = 0.0;     ///< wall time of this session
  std::string time_unit{};  ///< symbol; empty if times are dimensionless
  std::string gap{};        ///< smallest gap with its unit; empty for a single vesicle in unbounded fluid
};

/// Called after every step; may be empty.
using OnStatus = std::function<void(const RunStatus&)>;

}  // namespace vehd
