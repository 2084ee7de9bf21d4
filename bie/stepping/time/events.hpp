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

/// When snapshots are due after the start and before the end: whenever any of these asks for one, once where several
/// ask for the same moment.
struct SnapshotTimes {
  std::optional<double> every{};  ///< at k * every
  std::vector<double> times{};    ///< ascending
  std::vector<SnapshotWindow> windows{};

  /// The next one after `time`. What is apart from it or from the end by rounding is the same moment.
  /// @return nullopt if there is none before `end`
  /// Accuracy: each moment is one product or sum, so that the k-th does not drift
  /// (tests/stepping/time/step_plan_test.cpp)
  [[nodiscard]] std::optional<double> next(double time, double end) const;
  /// All of them between two times, neither of which is among them.
  [[nodiscard]] std::vector<double> between(double from, double to) const;
  /// Whether one is due at `time`, to rounding.
  [[nodiscard]] bool is_due(double time, double from, double end) const;
  /// How many there are until `end`, about: moments that coincide count each.
  [[nodiscard]] double count(double end) const;
};

/// The instants at which a step has to end exactly.
struct EventTimes {
  SnapshotTimes snapshots;
  double end_time = 0.0;
  std::optional<double> discontinuity = std::nullopt;  ///< where the forcing changes abruptly; no snapshot is due there
};

}  // namespace vehd
