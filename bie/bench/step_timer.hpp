#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "bie/scene/problem.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/memory.hpp"

namespace vehd {

/// Steps of one scene at its dt under the clock. The whole step has the name "step", what none of its parts contains
/// "other"; parts and other add up to it.
class StepTimer {
 public:
  /// Evaluates the start and takes the first steps unmeasured.
  /// @throws ConvergenceError
  explicit StepTimer(const Scene& scene);

  /// One step under the clock.
  void timed_step();
  /// Not timed.
  void metered_step();

  /// Names of the parts, "step" first, "other" last.
  [[nodiscard]] std::vector<std::string> parts() const;
  /// Of each timed step.
  [[nodiscard]] const std::map<std::string, std::vector<double>>& seconds() const { return seconds_; }
  /// Of the tension and of the velocity, of each timed step.
  [[nodiscard]] const std::vector<double>& iterations() const { return iterations_; }
  /// See MemoryMeter.
  [[nodiscard]] const std::map<std::string, std::int64_t>& bytes() const { return meter_.peaks(); }
  /// Floating-point operations of parts in the last step: kernels and matrix products of the assembly, and in the
  /// solves of a first-order step the applications of the Stokes operator, one an iteration.
  [[nodiscard]] std::map<std::string, double> operations() const;
  /// Of all operators and all steps so far.
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
/// solves have learnt nothing yet. Tables of the degree are made before.
/// @throws ConvergenceError
double seconds_to_the_first_step(const Scene& scene);

/// The scene with fixed steps: without its tolerance.
/// @param bench  its name on the command line
/// @throws InputError if it has no dt
Scene with_fixed_steps(Scene scene, const std::string& bench);

/// @param option  as on the command line
/// @throws InputError if a value is below the one before
void require_ascending(const std::string& option, const std::vector<int>& values);

}  // namespace vehd
