#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "bie/runs/checkpoint.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/simulation.hpp"

namespace vehd {

/// Estimated errors of a history from a second run of the scene that is less exact, the companion.
///
/// With a tolerance the companion has one ρ = 10 times as large and chooses degree and steps for itself; a row of the
/// history is a moment within its step. With fixed steps it makes one of three, ρ = 3^k at order k, and ends each on a
/// row. It lags behind the run by one of its steps at most. What the motion has done to errors since is in those of
/// both: those that its steps have left are ρ times as large, so the difference over ρ − 1 is the error of the run.
/// Degrees have no such ratio, and of a shape at rest they are all that is wrong: what they leave out is estimated from
/// the spectrum of both. With T of the companion and t of the run, D the largest difference of a row and e the run's
/// estimate of its last step, all relative,
///
///   E² = max(√(D² − min(T, D)²)/(ρ − 1), min(e, D/(ρ − 1)))² + (t min(1, D/T))²
///
/// and every column has the share E/D of its difference. Between two comparisons errors grow or die away exponentially.
///
/// Accuracy: see docs/run_files.md
/// Source: of this project
class ErrorBars {
 public:
  /// @param scene  of the run
  /// @param from   of a run that goes on; absent: a new one
  /// @throws ConvergenceError
  ErrorBars(const Scene& scene, const std::optional<CompanionState>& from, Ranks ranks = {});

  /// Solves everything at the start.
  void start();
  /// New rows of the history, those of the start and of every step.
  void add(const std::vector<RecordedSide>& sides);
  /// Lets the companion follow.
  /// @param to_end  no further rows will come
  /// @return  rows of history_error.csv that are known now, in the order and with the columns of the history: the time,
  ///          then errors. Not numbers once the companion cannot take a step
  std::vector<Vector> follow(bool to_end);
  /// With which a resumed run goes on.
  [[nodiscard]] CompanionState state() const;

 private:
  [[nodiscard]] double now() const { return companion_.evolution().state().time; }
  [[nodiscard]] Vector values_of(const RecordedSide& side) const;
  [[nodiscard]] double worst(const Vector& differences) const;
  [[nodiscard]] double step_error_until(const Vector& row) const;
  [[nodiscard]] double share_of(const Vector& differences, const Vector& run, const Vector& companion,
                                double step_error) const;
  [[nodiscard]] Vector errors_at(const Vector& run, const RecordedSide& companion, double step_error) const;
  bool follow_once(bool to_end);
  [[nodiscard]] std::optional<double> moment_before(double reach) const;
  [[nodiscard]] std::optional<double> fixed_end(bool to_end) const;
  void compare(std::vector<Vector>& known);
  void give_up(std::vector<Vector>& known);

  Scene scene_;  ///< of the companion
  HistoryKind kind_;
  double share_of_steps_;     ///< of a difference that steps have made that is the error
  int order_of_results_;      ///< degree of what the history tells of
  std::int64_t start_order_;  ///< of the companion
  Simulation companion_;
  LabFrameOutput lab_frame_output_;
  std::deque<Vector> waiting_;  ///< rows of the history without an error yet
  Vector node_;                 ///< errors of the last row at which both were compared
  Vector sizes_;                ///< largest magnitude in each column of the history so far
  bool lost_ = false;           ///< it cannot take a step
};

}  // namespace vehd
