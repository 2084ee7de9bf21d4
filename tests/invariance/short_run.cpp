#include "tests/invariance/short_run.hpp"

#include "bie/stepping/evaluation/lab_frame_output.hpp"
#include "bie/support/errors.hpp"
#include "tests/support/runs.hpp"

namespace vehd::testing {

ShortRun short_run(const Scene& scene, int most_steps) { return short_run(problem_of(scene), scene, most_steps); }

ShortRun short_run(const Problem& problem, const Scene& scene, int most_steps) {
  Instruments instruments;
  ShortRun run;
  run.bending_modulus = scene.membrane.bending_modulus.value_or(0.0);
  try {
    Evolution evolution(setup_of(problem), problem.start, instruments);
    const auto record = [&](const StepAttempt& step) {
      NumericalSettings settings = problem.settings;
      const std::size_t last = evolution.state().vesicles.size() - 1;
      settings.order = evolution.order(last);
      const State& state = evolution.state();
      const Evaluation& evaluation = evolution.evaluation();
      run.rows.push_back({in_laboratory(problem.frame, state),
                          LabFrameOutput(problem.frame, settings)
                              .diagnostics(evaluation.diagnostics, state, evaluation.fields)
                              .vesicles.back(),
                          step, evolution.order(last), evolution.truncation()});
    };
    evolution.evaluate_start();
    record({});
    while (evolution.state().time < scene.numerics.end_time && static_cast<int>(run.rows.size()) <= most_steps) {
      record(evolution.step(events_of(scene)));
    }
  } catch (const ConvergenceError& error) {
    run.stopped = true;
    run.reason = error.what();
  }
  return run;
}

ShortRun solved_run(const Scene& scene, int most_steps) { return solved_run(problem_of(scene), scene, most_steps); }

ShortRun solved_run(Problem problem, const Scene& scene, int most_steps) {
  const double usual = problem.settings.constraint_tolerance;
  solve_to_rounding(problem.settings);
  // Rounding in the area of a thin stomatocyte is close to the tolerance of solve_to_rounding: with that one,
  // convergence of a step would depend on the processor.
  problem.settings.constraint_tolerance = usual;
  return short_run(problem, scene, most_steps);
}

}  // namespace vehd::testing
