#pragma once

#include <string>
#include <vector>

#include "bie/stepping/evaluation/evaluation.hpp"

namespace vehd {

/// What became of one try at a step, and of the tries before it.
struct StepAttempt {
  bool accepted = false;
  std::string reason;           ///< why it was rejected; empty when accepted
  State state;                  ///< at its end, when accepted
  double dt = 0.0;              ///< its size
  double error_estimate = 0.0;  ///< the last correction: of x over the radius or of V_m over its size; 0 without one
  /// Relative area error that the step would have left without its constraint: a drift of the step's order.
  double raw_area = 0.0;
  std::vector<double> arrival_shifts;  ///< of each vesicle, see Motion
  /// Rejected, and so would be smaller ones: of which vesicles a higher degree is needed.
  std::vector<std::size_t> too_coarse;
  int rejected = 0;         ///< tries that were thrown away before it
  int iterations_flow = 0;  ///< of all tries; once the step is taken with those of the evaluation at its end
  int iterations_electric = 0;
  bool at_snapshot = false;  ///< a snapshot is due at its end
};

/// One try of size dt and of the order that the settings ask for, from a state and what was solved there.
/// Accuracy: order time_order in dt (tests/stepping/time/time_order_test.cpp); nothing is thrown where a solve fails:
/// the attempt says why
StepAttempt attempt_step(const Model& model, const Discretisation& discretisation, const State& state,
                         const SolvedFields& at_start, double dt, Instruments& instruments);

}  // namespace vehd
