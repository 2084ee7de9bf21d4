#pragma once

#include <optional>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/simulation.hpp"

namespace vehd {

/// Error bars of a history: its differences to a companion, a second and less exact run of the scene that follows it.
///
/// With a tolerance the companion has ten times as much, and a bar is half the difference. With fixed steps it makes
/// one step of two; at order k its error is 2^k times that of the run, and a bar is three times the error that follows.
/// Both are compared at the last row within each step of the companion, and on both sides of a jump. A row has the
/// larger of the differences before and behind it, and its truncation on top.
///
/// Accuracy: above the error in nine rows of ten, and below 30 times the error in nine of ten (docs/run_files.md)
/// Source: of this project
class ErrorBars {
 public:
  /// @param from  state of the companion of a resumed run; absent: a new one
  /// @throws ConvergenceError if the companion cannot be started
  ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks = {});

  /// New rows of the history, those of the start and of every step.
  void add(const std::vector<RecordedSide>& sides);
  /// Lets the companion follow.
  /// @param to_end  no further rows will come
  /// @return  the rows of history_error.csv that are known now, [n_columns] each with the columns of the history: the
  ///          time, then errors; NaN once the companion cannot take a step
  std::vector<Vector> follow(bool to_end);
  /// The companion's state, from which a resumed run continues.
  [[nodiscard]] CompanionState state() const;

 private:
  [[nodiscard]] Vector values_of(const RecordedSide& side) const;
  [[nodiscard]] Vector bars_of(const Vector& row, Vector differences) const;
  bool step(bool to_end);
  void compare(std::vector<Vector>& known);

  Scene scene_;  ///< of the companion
  std::vector<HistoryColumn> columns_;
  double factor_;  ///< bar over difference
  Simulation companion_;
  int order_of_results_;  ///< degree of the numbers of the history
  LabFrameOutput lab_frame_output_;
  CompanionState past_;  ///< all but the state of the companion
};

}  // namespace vehd
