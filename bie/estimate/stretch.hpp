#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bie/estimate/trial_run.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// Seconds of evaluations of new shapes, all that a step does beside them included.
struct TimedEvaluations {
  int order = 0;
  int count = 0;
  double seconds = 0.0;
};

/// What steps with a tighter tolerance are like at one place of a trial run.
struct Stretch {
  std::size_t step = 0;                   ///< of the trial run in whose place they begin; 0: at the scene's own start
  double steps_for_one = 1.0;             ///< that take the place of one of the trial run there
  double evaluations = 0.0;               ///< of new shapes by one try at one of them, without snapshots
  double share_with_past = 0.0;           ///< of them that begin with the extrapolation of the step before
  int more_degrees = 0;                   ///< than those with which it began, at most
  std::vector<TimedEvaluations> timed{};  ///< of those that tell
};

/// Steps of a stretch: one with the tolerance of the trial run, and five with the tighter one.
constexpr int steps_of_stretch = 6;

/// From so many states of a trial run, as many steps apart as may be: a few steps with a tighter tolerance. The degrees
/// that this needs are empty at first, and what belongs there grows within less than a step of the trial run: one of
/// those comes first, with the higher degree. The size of the first tighter step is a guess, those after it follow from
/// it while what the loose step has left dies away, and the last two and the size of the next one tell. Where there is
/// time for more than half of the stretches, one from the start of the scene comes beside them: motions that begin with
/// it take steps that nothing else tells.
/// @param orders  degrees with which to begin, of each step of the trial run
/// @param begins  asked before each whether there is time for it
/// @returns       those that could be taken, by their step
/// Accuracy: ten of them tell steps and work of a whole run within a factor of 2 (tests/estimate/prediction_test.cpp)
std::vector<Stretch> take_stretches(const Scene& scene, const TrialRun& trial, double tolerance, std::size_t count,
                                    const std::vector<int>& orders, const std::function<bool()>& begins,
                                    Deadline* deadline = nullptr);

}  // namespace vehd
