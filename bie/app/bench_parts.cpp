#include "bie/app/bench_parts.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bie/app/summary.hpp"
#include "bie/scene/problem.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Steps before the clock starts: the first ones charge the membrane and settle the grid.
constexpr int kWarmUp = 3;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

struct StepCost {
  std::vector<double> seconds;
  std::map<std::string, double> parts;  ///< mean per step
};

StepCost time_steps(const Scene& scene, int repeats) {
  const double no_end = 1e6 * *scene.numerics.dt;
  const Problem problem = problem_of(scene);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.position, problem.steady_potential, instruments);
  evolution.evaluate_start();
  for (int i = 0; i < kWarmUp; ++i) evolution.step({std::nullopt, no_end});
  const std::map<std::string, double> before = instruments.seconds();
  StepCost cost;
  for (int i = 0; i < repeats; ++i) {
    const auto start = std::chrono::steady_clock::now();
    evolution.step({std::nullopt, no_end});
    cost.seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  for (const auto& [name, seconds] : instruments.seconds()) {
    const auto earlier = before.find(name);
    cost.parts[name] = (seconds - (earlier == before.end() ? 0.0 : earlier->second)) / repeats;
  }
  return cost;
}

}  // namespace

nlohmann::json bench_parts(Scene scene, const std::vector<int>& orders, int repeats) {
  if (!scene.numerics.dt) throw InputError("bench parts needs a scene with \"dt\" in [numerics]");
  scene.numerics.tolerance.reset();
  nlohmann::json result = {{"threads", omp_get_max_threads()}, {"repeats", repeats}, {"dt", *scene.numerics.dt}};
  fmt::print("{} threads, dt = {}, {} timed steps\n", omp_get_max_threads(), *scene.numerics.dt, repeats);
  fmt::print("{:>6} {:>11} {:>9} {:>9} {:>7} {:>9}   parts of a step in seconds (mean)\n", "order", "s per step", "min",
             "max", "growth", "MB");
  double last_seconds = 0.0;
  int last_order = 0;
  for (const int order : orders) {
    scene.numerics.order = order;
    const StepCost cost = time_steps(scene, repeats);
    const double seconds = median(cost.seconds);
    const auto [low, high] = std::minmax_element(cost.seconds.begin(), cost.seconds.end());
    const std::string growth =
        last_order > 0 && order != last_order
            ? fmt::format("p^{:.1f}", std::log(seconds / last_seconds) / std::log(double(order) / last_order))
            : "";
    std::string parts;
    for (const auto& [name, value] : cost.parts) parts += fmt::format("{} {:.4f}  ", name, value);
    fmt::print("{:>6} {:>11.4f} {:>9.4f} {:>9.4f} {:>7} {:>9.0f}   {}\n", order, seconds, *low, *high, growth,
               static_cast<double>(peak_memory_bytes()) / 1e6, parts);
    result["orders"].push_back({{"order", order},
                                {"seconds", seconds},
                                {"seconds_min", *low},
                                {"seconds_max", *high},
                                {"parts", cost.parts},
                                {"peak_memory_bytes", peak_memory_bytes()}});
    last_seconds = seconds;
    last_order = order;
  }
  return result;
}

}  // namespace vehd
