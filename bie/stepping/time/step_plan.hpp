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

/// How far the next step goes.
struct StepPlan {
  double wanted = 0.0;         ///< its size if there were no events
  double dt = 0.0;             ///< its size
  double event_time = 0.0;     ///< next snapshot, discontinuity or the end
  bool reaches_event = false;  ///< the step ends at event_time
  bool is_snapshot = true;     ///< a snapshot is due at event_time
};

/// The way to the next event in equal steps no longer than is wanted, so that no sliver is left before it. A remainder
/// within 1e-9 of a whole number of steps counts as whole.
/// Accuracy: steps end on every event to rounding (tests/stepping/time/step_plan_test.cpp)
StepPlan plan_step(double time, double wanted, const EventTimes& events);

}  // namespace vehd
