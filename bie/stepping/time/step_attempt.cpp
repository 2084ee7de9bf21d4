#include "bie/stepping/time/step_attempt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/stepping/state/field_table.hpp"
#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

void StepAttempt::add_work_of(const StepAttempt& former) {
  rejected += former.rejected;
  *this += former;
}

void StepAttempt::reject(const std::string& why) {
  accepted = false;
  failed = true;
  reason = why;
}

namespace {

/// Largest relative area error of the motions, signed.
double raw_area_of(const NodeSolution& end) {
  double largest = 0.0;
  for (const Motion& vesicle : end.vesicles) {
    if (std::abs(vesicle.raw_area) >= std::abs(largest)) largest = vesicle.raw_area;
  }
  return largest;
}

void try_to_reach(const StepGoal& goal, double dt, int order, StepOperations& physics, StepAttempt& attempt) {
  ControlledSweeps sweeps = controlled_sweeps(physics, dt, order, goal);
  attempt.error_estimate = sweeps.excess * goal.tolerance;
  attempt.factor = sweeps.factor;
  attempt.state = std::move(sweeps.state);
  attempt.dense_states = std::move(sweeps.dense_states);
  attempt.accepted = sweeps.end.has_value();
  if (attempt.accepted) {
    attempt.raw_area = raw_area_of(*sweeps.end);
    for (const Motion& vesicle : sweeps.end->vesicles) attempt.arrival_shifts.push_back(vesicle.arrival_shift);
  } else {
    attempt.reason = fmt::format(
        "the estimated error of the step, divided by its share of the tolerance, is {:.1e}; accepted: {:.1e}",
        attempt.error_estimate, goal.tolerance);
  }
}

}  // namespace

StepAttempt attempt_step(const StepStart& start, double dt, Instruments& instruments, const StepGoal* goal) {
  const int order = start.discretisation.settings().time_order;
  StepOperations physics(start, instruments);
  StepAttempt attempt;
  attempt.dt = dt;
  try {
    if (goal != nullptr) {
      try_to_reach(*goal, dt, order, physics, attempt);
    } else {
      const CorrectedNode end = deferred_correction(physics, dt, order);
      attempt.error_estimate = end.last_correction;
      attempt.raw_area = raw_area_of(end.node);
      attempt.state = physics.end_state(end.node);
      attempt.accepted = true;
    }
    const auto finite = [](const VesicleState& vesicle) { return is_finite(vesicle); };
    if (attempt.accepted && !std::ranges::all_of(attempt.state.vesicles, finite)) {
      throw ConvergenceError("the state at the end of the step is not finite");
    }
  } catch (const ConvergenceError& error) {
    attempt.reject(error.what());
  }
  attempt += physics.work();
  return attempt;
}

}  // namespace vehd
