#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bie/scene/problem.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/memory.hpp"

namespace vehd {

/// Times the steps of one scene at its dt. The whole step is named "step", the time outside all parts "other"; the
/// parts and "other" add up to "step".
class StepTimer {
 public:
  /// Evaluates the start and takes the first steps without timing them.
  /// @throws ConvergenceError
  explicit StepTimer(const Scene& scene);

  /// Takes a step and times it.
  void timed_step();
  /// Takes a step without timing it and meters its memory.
  void metered_step();

  /// Names of the parts, "step" first, "other" last.
  [[nodiscard]] std::vector<std::string> parts() const;
  /// Seconds of each part in each timed step.
  [[nodiscard]] const std::map<std::string, std::vector<double>>& seconds() const { return seconds_; }
  /// Iterations of the tension and velocity solves in each timed step.
  [[nodiscard]] const std::vector<double>& iterations() const { return iterations_; }
  /// Peak memory of each part, see MemoryMeter.
  [[nodiscard]] const std::map<std::string, std::int64_t>& bytes() const { return meter_.peaks(); }
  /// Kernel evaluations of all operators and all steps so far.
  [[nodiscard]] std::uint64_t kernel_evaluations() const;
  [[nodiscard]] const State& state() const { return evolution_.state(); }

 private:
  void step();

  Problem problem_;
  MemoryMeter meter_;
  Instruments instruments_{&meter_};
  Evolution evolution_;
  StepAttempt last_;
  std::map<std::string, std::vector<double>> seconds_;
  std::vector<double> iterations_;
};

/// Seconds from the start of the scene to the end of its first step at its dt: the fields at the start and a step whose
/// solves have no recycled subspaces yet. Tables of the degree are computed before.
/// @throws ConvergenceError
double seconds_to_the_first_step(const Scene& scene);

/// The scene with fixed steps: without its tolerance.
/// @param bench  name on the command line
/// @throws InputError if it has no dt
Scene with_fixed_steps(Scene scene, const std::string& bench);

/// @param option  name on the command line
/// @throws InputError if a value is below the previous one
void require_ascending(const std::string& option, const std::vector<int>& values);

}  // namespace vehd
