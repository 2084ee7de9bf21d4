#include "bie/app/bench_time.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/laboratory.hpp"
#include "bie/stepping/resolution.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

struct Quantity {
  const char* name;
  double Diagnostics::*member;
};
constexpr std::array kQuantities = {
    Quantity{"extent_x", &Diagnostics::extent_x},
    Quantity{"extent_z", &Diagnostics::extent_z},
    Quantity{"bending_energy_scaled", &Diagnostics::bending_energy_scaled},
    Quantity{"tension_integral", &Diagnostics::tension_integral},
    Quantity{"Vm_north", &Diagnostics::Vm_north},
    Quantity{"inclination_deg", &Diagnostics::inclination_deg},
};

struct TimedRun {
  Diagnostics diagnostics;
  double seconds;
  std::int64_t n_steps;
  int highest_order;
};

TimedRun run_to(const Scene& scene, double end_time) {
  const Problem problem = problem_of(scene);
  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.position, problem.steady_potential, instruments);
  evolution.evaluate_start();
  int highest_order = evolution.order();
  while (evolution.state().time < end_time) {
    evolution.step({std::nullopt, end_time});
    highest_order = std::max(highest_order, evolution.order());
  }
  const Laboratory laboratory(problem.frame, problem.settings);
  const State state = resized(evolution.state(), problem.settings.order);
  const Fields fields = resized(evolution.evaluation().fields, problem.settings.order);
  return {laboratory.diagnostics(evolution.evaluation().diagnostics, state, fields),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), state.step, highest_order};
}

/// Difference of one quantity over its size; angles over a radian.
double relative_error(const Quantity& quantity, const Diagnostics& d, const Diagnostics& reference) {
  constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
  const double value = reference.*quantity.member;
  const double difference = std::abs(d.*quantity.member - value);
  if (quantity.member == &Diagnostics::inclination_deg) {
    return std::min(difference, 180.0 - difference) / kDegreesPerRadian;
  }
  return difference == 0.0 ? 0.0 : difference / std::abs(value);
}

}  // namespace

nlohmann::json bench_time(const Scene& scene, const std::vector<double>& steps, double at) {
  for (std::size_t i = 1; i < steps.size(); ++i) {
    if (std::abs(steps[i] - 0.5 * steps[i - 1]) > 1e-12 * steps[i - 1]) {
      throw InputError(fmt::format("--dt: {} is not half of {}", steps[i], steps[i - 1]));
    }
  }
  nlohmann::json result = {{"order", scene.numerics.order}, {"time", at}};
  fmt::print("order {}, values at time {}\n{:>10} {:>9}", scene.numerics.order, at, "dt", "seconds");
  for (const Quantity& quantity : kQuantities) fmt::print(" {:>22}", quantity.name);
  fmt::print("\n");
  std::vector<TimedRun> runs;
  for (const double dt : steps) {
    Scene stepped = scene;
    stepped.numerics.tolerance.reset();
    stepped.numerics.dt = dt;
    runs.push_back(run_to(stepped, at));
    fmt::print("{:>10g} {:>9.2f}", dt, runs.back().seconds);
    nlohmann::json row = {{"dt", dt}, {"seconds", runs.back().seconds}};
    for (const Quantity& quantity : kQuantities) {
      fmt::print(" {:>22.6f}", runs.back().diagnostics.*quantity.member);
      row[quantity.name] = runs.back().diagnostics.*quantity.member;
    }
    fmt::print("\n");
    std::fflush(stdout);
    result["runs"].push_back(row);
  }
  for (std::size_t i = 2; i < runs.size(); ++i) {
    std::string orders = fmt::format("{:>20}", "observed order");
    std::string limits = fmt::format("{:>20}", "extrapolated");
    for (const Quantity& quantity : kQuantities) {
      const double coarse = runs[i - 2].diagnostics.*quantity.member;
      const double middle = runs[i - 1].diagnostics.*quantity.member;
      const double fine = runs[i].diagnostics.*quantity.member;
      const double ratio = (coarse - middle) / (middle - fine);
      // Values that do not move monotonically, or not at all, have no order.
      const bool converging = std::isfinite(ratio) && ratio > 1.0 && std::abs(middle - fine) > 1e-9 * std::abs(fine);
      orders += converging ? fmt::format(" {:>22.2f}", std::log2(ratio)) : fmt::format(" {:>22}", "-");
      limits +=
          converging ? fmt::format(" {:>22.6f}", fine + (fine - middle) / (ratio - 1.0)) : fmt::format(" {:>22}", "-");
    }
    fmt::print("{}\n{}\n", orders, limits);
  }
  return result;
}

nlohmann::json bench_tolerance(const Scene& scene, const std::vector<double>& tolerances, double at) {
  for (std::size_t i = 1; i < tolerances.size(); ++i) {
    if (!(tolerances[i] < tolerances[i - 1])) {
      throw InputError(fmt::format("--tolerance: {} is not below {}", tolerances[i], tolerances[i - 1]));
    }
  }
  std::vector<TimedRun> runs;
  for (const double tolerance : tolerances) {
    Scene asked = scene;
    const AccuracyDefaults defaults = accuracy_defaults(tolerance);
    asked.numerics.tolerance = tolerance;
    asked.numerics.dt.reset();
    asked.numerics.order = defaults.order;
    asked.numerics.time_order = defaults.time_order;
    asked.numerics.end_time = at;
    runs.push_back(run_to(asked, at));
    fmt::print(stderr, "tolerance {:.0e}: {:.1f} s\n", tolerance, runs.back().seconds);
  }
  nlohmann::json result = {{"time", at}, {"reference", tolerances.back()}};
  fmt::print("time {}, errors against the last row\n{:>9} {:>9} {:>7} {:>7} {:>10}", at, "tolerance", "seconds",
             "steps", "degree", "error/tol");
  for (const Quantity& quantity : kQuantities) fmt::print(" {:>22}", quantity.name);
  fmt::print("\n");
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const TimedRun& run = runs[i];
    nlohmann::json row = {
        {"tolerance", tolerances[i]}, {"seconds", run.seconds}, {"steps", run.n_steps}, {"order", run.highest_order}};
    std::string errors;
    double largest = 0.0;
    for (const Quantity& quantity : kQuantities) {
      const double error = relative_error(quantity, run.diagnostics, runs.back().diagnostics);
      largest = std::max(largest, error);
      errors += fmt::format(" {:>22.1e}", error);
      row["errors"][quantity.name] = error;
    }
    fmt::print("{:>9.0e} {:>9.2f} {:>7} {:>7} {:>10.2f}{}\n", tolerances[i], run.seconds, run.n_steps,
               run.highest_order, largest / tolerances[i], errors);
    result["runs"].push_back(row);
  }
  return result;
}

}  // namespace vehd
