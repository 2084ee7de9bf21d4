// Two steps of a scene file: a program of one's own around the solver.
#include <bie/scene/problem.hpp>
#include <bie/scene/reader.hpp>
#include <bie/stepping/evolution.hpp>
#include <cmath>
#include <cstdio>
#include <exception>

int main(int n_arguments, char** arguments) try {
  if (n_arguments != 2) {
    std::fputs("usage: steps SCENE.toml\n", stderr);
    return 1;
  }
  const vehd::Problem problem = vehd::problem_of(vehd::read_scene(arguments[1]));
  vehd::Instruments instruments;
  vehd::Evolution evolution(vehd::setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  double drift = 0.0;
  for (int step = 0; step < 2; ++step) {
    evolution.step({{}, 1e9 * problem.control.largest});
    const vehd::VesicleDiagnostics& vesicle = evolution.evaluation().diagnostics.vesicles[0];
    drift = std::max(drift, std::abs(vesicle.area_drift));
    std::printf("t = %g, extent along z %.6f\n", evolution.state().time, vesicle.extent_z);
  }
  return drift < 1e-3 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}
