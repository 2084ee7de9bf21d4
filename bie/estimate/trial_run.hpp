#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bie/scene/scene.hpp"

namespace vehd {

/// One accepted step of a pilot run and what it foretells.
struct PilotStep {
  double time = 0.0;  ///< at its end
  double dt = 0.0;
  double change = 0.0;  ///< see StepResult
  int attempts = 1;
  int order = 0;
  bool at_snapshot = false;
  std::vector<int> orders;  ///< degree that each of the tolerances asked for would need here
};

/// A run with one tolerance, without files.
struct Pilot {
  double tolerance = 0.0;
  int time_order = 0;
  int highest_order = 0;
  bool completed = false;  ///< reached the end of the scene
  std::string stops;       ///< why no further step could be taken; empty where that is not what ended it
  double seconds = 0.0;
  std::vector<PilotStep> steps;
};

/// Where a pilot stops before the end of its scene: at whichever comes first, after one step at the earliest. Steps are
/// the same on every machine.
struct PilotBudget {
  double seconds = std::numeric_limits<double>::infinity();
  std::int64_t steps = std::numeric_limits<std::int64_t>::max();  ///< accepted ones
};

/// @param tolerances  for which degrees are predicted from the spectrum of each state
Pilot run_pilot(const Scene& scene, double tolerance, const std::vector<double>& tolerances, const PilotBudget& budget);

}  // namespace vehd
