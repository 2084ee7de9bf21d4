#include "bie/app/menu.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "bie/app/summary.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/evolution.hpp"

namespace vehd {
namespace {

/// Least factor of the number of steps and least number of degrees that a digit costs: loose runs may be ruled by
/// snapshots and by the lowest degree, tight ones are not.
constexpr double kStepGrowth = 1.5;
constexpr double kDegreesPerDigit = 3.0;
/// Growth of a step with its degree, solver iterations included.
constexpr double kCostExponent = 3.0;
/// Memory of the program before it knows a scene.
constexpr double kProgramBytes = 20e6;

/// The whole run, without files.
MenuRow pilot(Scene scene, double tolerance) {
  const auto start = std::chrono::steady_clock::now();
  const AccuracyDefaults defaults = accuracy_defaults(tolerance);
  // The step of a scene without a tolerance is its accuracy, not a bound.
  if (!scene.numerics.tolerance) scene.numerics.dt.reset();
  scene.numerics.tolerance = tolerance;
  scene.numerics.order = defaults.order;
  scene.numerics.time_order = defaults.time_order;
  const Problem problem = problem_of(scene);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.position, problem.steady_potential, instruments);
  evolution.evaluate_start();
  MenuRow row;
  row.tolerance = tolerance;
  row.measured = true;
  row.order = evolution.order();
  while (evolution.state().time < scene.numerics.end_time) {
    evolution.step({scene.output.every, scene.numerics.end_time});
    row.steps += 1.0;
    row.order = std::max(row.order, static_cast<double>(evolution.order()));
  }
  row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  row.memory_bytes = peak_memory_bytes();
  return row;
}

/// The row that continues measured ones. @param before  null where there is only one
MenuRow continued(const MenuRow* before, const MenuRow& last, double tolerance) {
  const double digits = std::log10(last.tolerance / tolerance);
  double growth = kStepGrowth;
  double degrees = kDegreesPerDigit;
  if (before != nullptr) {
    const double known = std::log10(before->tolerance / last.tolerance);
    growth = std::max(growth, std::pow(last.steps / before->steps, 1.0 / known));
    degrees = std::max(degrees, (last.order - before->order) / known);
  }
  MenuRow row;
  row.tolerance = tolerance;
  row.order = std::min(static_cast<double>(accuracy_defaults(tolerance).order), last.order + degrees * digits);
  row.steps = last.steps * std::pow(growth, digits);
  row.seconds = last.seconds * row.steps / last.steps * std::pow(row.order / last.order, kCostExponent);
  // Operators have p^4 entries.
  const double operators =
      (static_cast<double>(last.memory_bytes) - kProgramBytes) * std::pow(row.order / last.order, 4);
  row.memory_bytes = static_cast<std::int64_t>(kProgramBytes + operators);
  return row;
}

}  // namespace

std::vector<MenuRow> menu_of(const Scene& scene, const std::vector<double>& tolerances, double seconds) {
  std::vector<MenuRow> rows;
  double spent = 0.0;
  std::size_t n_measured = 0;
  for (const double tolerance : tolerances) {
    if (n_measured == rows.size()) {
      const bool affordable =
          rows.empty() ||
          spent + continued(n_measured > 1 ? &rows[n_measured - 2] : nullptr, rows.back(), tolerance).seconds <=
              seconds;
      if (affordable) {
        rows.push_back(pilot(scene, tolerance));
        spent += rows.back().seconds;
        ++n_measured;
        continue;
      }
    }
    rows.push_back(continued(n_measured > 1 ? &rows[n_measured - 2] : nullptr, rows[n_measured - 1], tolerance));
  }
  return rows;
}

}  // namespace vehd
