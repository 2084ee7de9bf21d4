#pragma once

#include <string>
#include <vector>

#include "bie/scene/problem.hpp"

namespace vehd::testing {

/// Results after one step, or at the start.
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
  bool stopped = false;  ///< before its end and before `most_steps` steps
  std::string reason;    ///< why it stopped
};

/// The start of a scene and at most `most_steps` steps of it.
ShortRun short_run(const Scene& scene, int most_steps);

/// The start and at most `most_steps` steps of a changed problem of the scene.
ShortRun short_run(const Problem& problem, const Scene& scene, int most_steps);

/// short_run with solves that go on to rounding, except for area and volume: the usual residuals, up to 1e-5 of a
/// step's change of curvature, differ if iterations end elsewhere.
ShortRun solved_run(const Scene& scene, int most_steps);

/// solved_run of a changed problem of the scene.
ShortRun solved_run(Problem problem, const Scene& scene, int most_steps);

}  // namespace vehd::testing
