#pragma once

#include <string>
#include <vector>

#include "bie/scene/problem.hpp"

namespace vehd::testing {

/// What is known after one step, or at the start.
struct RunRow {
  State state;                     ///< in laboratory coordinates
  VesicleDiagnostics diagnostics;  ///< of the last vesicle
  StepAttempt step;
  int order = 0;
  double truncation = 0.0;  ///< see Evolution::truncation
};

struct ShortRun {
  std::vector<RunRow> rows;
  double bending_modulus = 0.0;
  bool stopped = false;  ///< before its end and before the most steps
  std::string reason;    ///< why
};

/// The start of a scene and at most `most_steps` steps of it.
ShortRun short_run(const Scene& scene, int most_steps);

/// The same of a changed problem of the scene.
ShortRun short_run(const Problem& problem, const Scene& scene, int most_steps);

/// With solves that go on to rounding, but for area and volume: what the usual ones leave, up to 1e-5 of a step's
/// change of curvature, is another remainder where they end elsewhere.
ShortRun solved_run(const Scene& scene, int most_steps);

/// The same of a changed problem of the scene.
ShortRun solved_run(Problem problem, const Scene& scene, int most_steps);

}  // namespace vehd::testing
