#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/deadline.hpp"

namespace vehd {

/// One accepted step of a trial run and what it predicts.
struct TrialStep {
  double time = 0.0;  ///< at its end
  double dt = 0.0;
  double error_estimate = 0.0;  ///< see StepAttempt
  int evaluations = 1;          ///< of new shapes, of all tries
  int rejected = 0;             ///< tries
  int moments = 0;              ///< of those, the ones at snapshots within the step
  int order = 0;
  std::vector<int> orders;  ///< degree that each of the tolerances asked for would need here
  std::vector<int>
      idle_orders;  ///< and to which a run with it would go down here, from one that is worthwhile to leave
};

/// Where a trial run was between two of its steps.
struct TrialState {
  std::size_t step = 0;  ///< steps before it
  State state;           ///< without what is recycled
};

/// A run with one tolerance, without files.
struct TrialRun {
  double tolerance = 0.0;
  int highest_order = 0;
  bool completed = false;  ///< reached the end of the scene
  std::string stops;       ///< why no further step could be taken; empty where that is not what ended it
  double seconds = 0.0;    ///< of its start and its steps, without what they are asked for other tolerances
  std::vector<TrialStep> steps;
  std::vector<TrialState> states;  ///< its start and others, as many steps apart, before each of which it took a step
};

/// Where a trial run stops before the end of its scene: at whichever comes first, after one step at the earliest unless
/// that is given up. Steps are the same on every machine.
struct TrialBudget {
  double seconds = std::numeric_limits<double>::infinity();
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();  ///< accepted ones
  Deadline* deadline = nullptr;                                   ///< gives up a step that has begun; null: none
};

/// @param tolerances  for which degrees are predicted from the spectrum of each state
/// @param tolerance   of the trial run itself
/// @throws InputError if the shape file of the scene cannot be used
TrialRun run_trial(const Scene& scene, double tolerance, const std::vector<double>& tolerances,
                   const TrialBudget& budget);

/// Degree of a run of a scene with this tolerance after its first step, of the vesicle that has the highest.
/// @throws ConvergenceError, OutOfTime, InputError if the shape file of the scene cannot be used
int starting_order(const Scene& scene, double tolerance, Deadline* deadline = nullptr);

}  // namespace vehd
