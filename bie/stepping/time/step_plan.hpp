#pragma once

#include <optional>

#include "bie/stepping/time/snapshot_times.hpp"

namespace vehd {

/// The instants at which a step has to end exactly.
struct EventTimes {
  SnapshotTimes snapshots;
  double end_time = 0.0;
  std::optional<double> discontinuity = std::nullopt;  ///< where the forcing changes abruptly; no snapshot is due there
};

/// How far the next step may go.
struct StepPlan {
  double event_time = 0.0;  ///< next snapshot, discontinuity or the end
  double dt_limit = 0.0;
  bool reaches_event = false;  ///< a step of size dt_limit ends at event_time
  bool is_snapshot = true;     ///< a snapshot is due at event_time
};

/// The way to the next event in equal steps no longer than dt, so that no sliver is left before it. A remainder
/// within 1e-9 of a whole number of steps counts as whole.
/// Accuracy: steps end on every event to rounding (tests/stepping/time/step_plan_test.cpp)
StepPlan plan_step(double time, double dt, const EventTimes& events);

}  // namespace vehd
