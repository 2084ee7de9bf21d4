#pragma once

#include <string>
#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"
#include "bie/stepping/time/deferred_correction.hpp"

namespace vehd {

/// Result of one attempt at a step. Its work is that of all attempts at the step and, once it is accepted, of the
/// evaluation at its end.
struct StepAttempt : StepWork {
  bool accepted = false;
  bool failed = false;  ///< rejected because a solve failed
  std::string reason;   ///< why it was rejected; empty when accepted
  State state;          ///< at its end, when accepted
  double dt = 0.0;      ///< its size
  /// Without a tolerance the last correction, of x over the radius or of V_m over its size; 0 without one. With a
  /// tolerance the estimated error of the step over the share of the tolerance that one step may leave.
  double error_estimate = 0.0;
  /// Relative area error that the step would have left without its constraint: a drift of the step's order.
  double raw_area = 0.0;
  std::vector<double> arrival_shifts;  ///< Motion::arrival_shift of each vesicle at its end, when accepted
  std::vector<State> dense_states;     ///< at the requested times within the step
  double factor = 1.0;                 ///< best size over this one, see ControlledSweeps
  int rejected = 0;                    ///< earlier attempts at the step
  bool at_snapshot = false;            ///< a snapshot is due at its end

  /// Adds the work of the attempts before this one.
  void add_work_of(const StepAttempt& former);
  /// Rejects it because a solve failed.
  void reject(const std::string& why);
};

/// One attempt of size dt and of the order of the settings. If a solve fails, the attempt is rejected with the reason;
/// nothing is thrown.
/// @param goal  null without a tolerance
/// Accuracy: order time_order in dt (tests/stepping/time/time_order_test.cpp)
StepAttempt attempt_step(const StepStart& start, double dt, Instruments& instruments, const StepGoal* goal = nullptr);

}  // namespace vehd
