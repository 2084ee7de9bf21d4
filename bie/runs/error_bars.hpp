#pragma once

#include <optional>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/simulation.hpp"

namespace vehd {

/// Error bars of a history: its differences from a companion, a second, less accurate run of the scene that follows it.
///
/// With a tolerance, the companion's is ten times larger, and a bar is half the difference. With fixed steps, its step
/// is twice that of the run; at order k its error is 2^k times larger, and a bar is three times the error that follows.
/// Both runs are compared at the last row within each step of the companion, and on both sides of a jump. A row takes
/// the larger difference of those before and after it; with a tolerance its truncation is added.
///
/// Accuracy: above the error in nine rows of ten, and below 30 times the error in nine of ten (docs/run_files.md)
/// Source: of this project
class ErrorBars {
 public:
  /// @param from  companion state of a resumed run; absent: a new companion
  /// @throws ConvergenceError if the companion cannot be started
  ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks = {});

  /// Adds new rows of the history: those of the start and of every step.
  void add(const std::vector<RecordedSide>& sides);
  /// Advances the companion as far as the rows allow.
  /// @param to_end  no further rows will come
  /// @return  rows of history_error.csv that became known, [n_columns] each, with the columns of the history: the time,
  ///          then errors; NaN once the companion cannot take a step
  std::vector<Vector> follow(bool to_end);
  /// The companion's state, from which a resumed run continues.
  [[nodiscard]] CompanionState state() const;

 private:
  [[nodiscard]] Vector values_of(const RecordedSide& side) const;
  [[nodiscard]] Vector bars_of(const Vector& row, Vector differences) const;
  bool step(bool to_end);
  void compare(std::vector<Vector>& known);

  Scene scene_;  ///< scene of the companion
  std::vector<HistoryColumn> columns_;
  double factor_;  ///< ratio of bar to difference
  Simulation companion_;
  int order_of_results_;  ///< degree of the results of the run
  LabFrameOutput lab_frame_output_;
  CompanionState progress_;  ///< all members but the state of the companion
};

}  // namespace vehd
