#pragma once

#include <optional>
#include <vector>

namespace vehd {

/// Snapshots at from + k * every up to `to`.
struct SnapshotWindow {
  double from = 0.0;
  double to = 0.0;
  double every = 0.0;
};

/// Times at which snapshots are due after the start and before the end: all times of any member, each once.
struct SnapshotTimes {
  std::optional<double> every{};  ///< at k * every
  std::vector<double> times{};    ///< ascending
  std::vector<SnapshotWindow> windows{};

  /// The next snapshot after `time`. Times that differ only by rounding from it or from the end count as equal.
  /// @return nullopt if there is none before `end`
  /// Accuracy: each time is one product or sum, so that the k-th does not drift
  /// (tests/stepping/time/step_plan_test.cpp)
  [[nodiscard]] std::optional<double> next(double time, double end) const;
  /// All snapshots strictly between two times.
  [[nodiscard]] std::vector<double> between(double from, double to) const;
  /// Whether a snapshot is due at `time`, to rounding.
  [[nodiscard]] bool is_due(double time, double from, double end) const;
  /// Approximate number of snapshots until `end`: times that coincide are counted repeatedly.
  [[nodiscard]] double count(double end) const;
};

/// Times at which a step must end exactly.
struct EventTimes {
  SnapshotTimes snapshots;
  double end_time = 0.0;
  std::optional<double> discontinuity = std::nullopt;  ///< where the forcing changes abruptly; no snapshot is due there
};

}  // namespace vehd
