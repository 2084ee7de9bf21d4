#include "bie/app/bench_time.hpp"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>

#include "bie/app/step_plan.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/composition.hpp"
#include "bie/stepping/laboratory.hpp"
#include "bie/stepping/stepper.hpp"
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
};

TimedRun run_to(const Scene& scene, double dt, double end_time) {
  const Problem problem = problem_of(scene);
  const Model& model = problem.model;
  const Discretisation discretisation(problem.settings, problem.symmetry);
  const bool steady = scene.electric && scene.electric->initial_potential == InitialPotential::steady;
  const auto start = std::chrono::steady_clock::now();
  Instruments instruments;
  State state = initial_state(model, discretisation, problem.position, steady, dt, instruments);
  Evaluation evaluation = evaluate(model, discretisation, state, instruments);
  while (state.time < end_time) {
    const StepPlan plan =
        plan_step(state.time, state.dt_next, {std::nullopt, end_time, next_corner(model, state.time)});
    Advance advanced = advance(model, discretisation, state, evaluation, dt, plan.dt_limit, instruments);
    if (!advanced.accepted)
      throw ConvergenceError(fmt::format("dt = {}, time {}: {}", dt, state.time, advanced.reason));
    state = std::move(advanced.state);
    if (plan.reaches_event && advanced.dt == plan.dt_limit) state.time = plan.event_time;
    evaluation = evaluate(model, discretisation, state, instruments, &evaluation);
  }
  const Laboratory laboratory(problem.frame, discretisation.settings());
  return {laboratory.diagnostics(evaluation.diagnostics, state, evaluation.fields),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
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
    runs.push_back(run_to(scene, dt, at));
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

}  // namespace vehd
