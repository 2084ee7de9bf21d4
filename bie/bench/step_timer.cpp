#include "bie/bench/step_timer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Steps in which the membrane charges, the grid settles and the solves collect recycled subspaces.
constexpr int kWarmUp = 20;
constexpr const char* kStep = "step";
constexpr const char* kOther = "other";

}  // namespace

StepTimer::StepTimer(const Scene& scene)
    : problem_(problem_of(scene)), evolution_(setup_of(problem_), problem_.start, instruments_) {
  evolution_.evaluate_start();
  for (int i = 0; i < kWarmUp; ++i) step();
}

void StepTimer::step() {
  const double no_end = evolution_.state().time + 1e3 * problem_.control.largest;
  last_ = evolution_.step({{}, no_end});
}

void StepTimer::timed_step() {
  const std::map<std::string, double> before = instruments_.seconds();
  const auto start = std::chrono::steady_clock::now();
  step();
  const double whole = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  double in_parts = 0.0;
  for (const auto& [name, total] : instruments_.seconds()) {
    const auto earlier = before.find(name);
    const double seconds = total - (earlier == before.end() ? 0.0 : earlier->second);
    seconds_[name].push_back(seconds);
    in_parts += seconds;
  }
  seconds_[kOther].push_back(whole - in_parts);
  seconds_[kStep].push_back(whole);
  iterations_.push_back(last_.iterations_flow);
}

void StepTimer::metered_step() {
  meter_.start();
  meter_.begin(kStep);
  step();
  meter_.end();
  meter_.stop();
}

std::vector<std::string> StepTimer::parts() const {
  std::vector<std::string> parts{kStep};
  for (const auto& [name, values] : seconds_) {
    if (name != kStep && name != kOther) parts.push_back(name);
  }
  parts.emplace_back(kOther);
  return parts;
}

std::uint64_t StepTimer::kernel_evaluations() const {
  std::uint64_t sum = 0;
  for (const auto& [kernel, count] : instruments_.kernel_evaluations()) sum += count;
  return sum;
}

double seconds_to_the_first_step(const Scene& scene) {
  const Problem problem = problem_of(scene);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  const auto start = std::chrono::steady_clock::now();
  evolution.evaluate_start();
  (void)evolution.step({{}, evolution.state().time + 1e3 * problem.control.largest});
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Scene with_fixed_steps(Scene scene, const std::string& bench) {
  if (!scene.numerics.dt) throw InputError(fmt::format("bench {} needs a scene with \"dt\" in [numerics]", bench));
  scene.numerics.tolerance.reset();
  return scene;
}

void require_ascending(const std::string& option, const std::vector<int>& values) {
  const auto wrong = std::ranges::is_sorted_until(values);
  if (wrong == values.end()) return;
  throw InputError(fmt::format("{}: {} after a higher one; accepted: ascending", option, *wrong));
}

}  // namespace vehd
