#include "bie/stepping/time/step_attempt.hpp"

#include <algorithm>
#include <cmath>

#include "bie/stepping/time/deferred_correction.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

StepAttempt attempt_step(const Model& model, const Discretisation& discretisation, const State& state,
                         const SolvedFields& at_start, double dt, Instruments& instruments) {
  StepOperations physics(model, discretisation, state, at_start, instruments);
  StepAttempt attempt;
  attempt.dt = dt;
  try {
    const CorrectedNode end = deferred_correction(physics, dt, discretisation.settings().time_order);
    attempt.error_estimate = end.last_correction;
    for (const Motion& vesicle : end.node.vesicles) {
      if (std::abs(vesicle.raw_area) >= std::abs(attempt.raw_area)) attempt.raw_area = vesicle.raw_area;
      attempt.arrival_shifts.push_back(vesicle.arrival_shift);
    }
    attempt.state = physics.end_state(end.node);
    attempt.accepted = true;
  } catch (const ConvergenceError& error) {
    attempt.reason = error.what();
  }
  attempt.iterations_flow = physics.iterations_flow();
  attempt.iterations_electric = physics.iterations_electric();
  return attempt;
}

}  // namespace vehd
