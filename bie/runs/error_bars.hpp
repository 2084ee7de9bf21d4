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
/// With a tolerance the companion has one ρ = 10 times as large and steps of an order less, and chooses degree and
/// steps for itself; a row of the history is a moment within its step. Where its work is too large a part of that of
/// the run, and where a period limits the steps of both, it is frugal: it has the order of the run, and its steps end
/// on rows that are near. With fixed steps it makes one of three, and ends each on a row. It lags behind the run by one
/// of its steps and one of the run at most. What the motion has done to errors since is in those of both: those that
/// its steps have left are r times as large, so the difference over r − 1 is the error of the run. With fixed steps r =
/// 3^k at order k. With a tolerance r² = ρ min(ρ, max(1, e_c/e_r)), e_c being what the companion has estimated of its
/// last step and e_r the geometric mean of what the run has of its steps since the last comparison; r = ρ where e_c <
/// D/ρ. Degrees have no such ratio, and of a shape at rest they are all that is wrong: what they leave out is estimated
/// from the spectrum of both. With T of the companion and t of the run, D the largest difference of a row and e the
/// run's estimate of its last step, all relative,
///
///   E² = max(√(D² − min(T, D)²)/(r − 1), min(e, D/(r − 1)))² + (t min(1, D/T))²
///
/// and every column has the share E/D of its difference, in the mean (of logarithms) with those of the comparison
/// before by 0.7 and 0.3. Between two comparisons errors grow or die away exponentially. No row is wrong by less than
/// 0.3 t.
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
  [[nodiscard]] double ratio_of_steps(double difference) const;
  [[nodiscard]] double share_of(const Vector& differences, const Vector& run, const Vector& companion) const;
  [[nodiscard]] Vector errors_at(const Vector& run, const RecordedSide& companion) const;
  [[nodiscard]] Vector told(const Vector& run, Vector errors) const;
  bool follow_once(bool to_end);
  [[nodiscard]] bool is_frugal() const;
  [[nodiscard]] std::optional<double> row_near(double reach) const;
  [[nodiscard]] std::optional<double> moment_before(double reach, int least) const;
  [[nodiscard]] std::optional<double> fixed_end(bool to_end) const;
  void compare(std::vector<Vector>& known);
  void give_up(std::vector<Vector>& known);

  Scene scene_;  ///< of the companion
  HistoryKind kind_;
  int time_order_of_run_;
  bool has_limited_steps_;    ///< by a period or dt, with a tolerance
  int order_of_results_;      ///< degree of what the history tells of
  std::int64_t start_order_;  ///< of the companion
  Simulation companion_;
  LabFrameOutput lab_frame_output_;
  std::deque<Vector> waiting_;  ///< rows of the history without an error yet
  Vector node_;                 ///< errors of the last row at which both were compared
  Vector sizes_;                ///< largest magnitude in each column of the history so far
  bool lost_ = false;           ///< it cannot take a step
  /// Of all steps so far, evaluations by the cube of their degree.
  struct Work {
    double of_run = 0.0, of_companion = 0.0;
  } work_;
};

}  // namespace vehd
