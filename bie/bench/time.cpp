#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "bie/bench/benches.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/evaluation/lab_frame_output.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

struct Quantity {
  const char* name;
  double VesicleDiagnostics::*member;
  bool shown = true;  ///< among the printed values
};
constexpr std::array kQuantities = {
    Quantity{"extent_x", &VesicleDiagnostics::extent_x},
    Quantity{"extent_y", &VesicleDiagnostics::extent_y, false},
    Quantity{"extent_z", &VesicleDiagnostics::extent_z},
    Quantity{"reduced_volume", &VesicleDiagnostics::reduced_volume, false},
    Quantity{"bending_energy_scaled", &VesicleDiagnostics::bending_energy_scaled},
    Quantity{"tension_integral", &VesicleDiagnostics::tension_integral},
    Quantity{"Vm_north", &VesicleDiagnostics::Vm_north},
    Quantity{"q_north", &VesicleDiagnostics::q_north, false},
    Quantity{"Vm_max", &VesicleDiagnostics::Vm_max, false},
    Quantity{"inclination_deg", &VesicleDiagnostics::inclination_deg},
};

struct TimedRow {
  double time = 0.0;
  std::vector<VesicleDiagnostics> vesicles;
};

struct TimedRun {
  std::string integrator, setting;
  BenchCell dt{}, tolerance{};
  std::vector<TimedRow> rows{};  ///< with a tolerance: at the start, at snapshots and at the end; otherwise at the end
  std::vector<double> seconds{};
  std::int64_t n_steps = 0;
  int highest_order = 0;
  double raw_drift = 0.0;  ///< Σ |raw_area| per unit time
};

void run_once(const Scene& scene, const EventTimes& events, TimedRun& run, BenchObserver& observer) {
  const Problem problem = problem_of(scene);
  const auto start = std::chrono::steady_clock::now();
  const auto elapsed = [start] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.start, instruments);
  const LabFrameOutput lab_frame(problem.frame, problem.settings);
  const auto row_of = [&](const State& state, const Evaluation& evaluation) {
    const Fields fields = resized(evaluation.fields, problem.settings.order);
    return TimedRow{
        state.time,
        lab_frame.diagnostics(evaluation.diagnostics, resized(state, problem.settings.order), fields).vesicles};
  };
  run.rows.clear();
  evolution.evaluate_start();
  run.highest_order = highest_order_of(evolution.state());
  if (scene.numerics.tolerance) run.rows.push_back(row_of(evolution.state(), evolution.evaluation()));
  double raw_area = 0.0;
  while (evolution.state().time < events.end_time) {
    const StepAttempt step = evolution.step(events);
    run.highest_order = std::max(run.highest_order, highest_order_of(evolution.state()));
    raw_area += std::abs(step.raw_area);
    for (const Evolution::DenseOutput& moment : evolution.dense_output()) {
      run.rows.push_back(row_of(moment.state, moment.evaluation));
    }
    if (step.at_snapshot && evolution.state().time < events.end_time) {
      run.rows.push_back(row_of(evolution.state(), evolution.evaluation()));
    }
    double drift = 0.0;
    for (const VesicleDiagnostics& now : evolution.evaluation().diagnostics.vesicles) {
      drift = std::max({drift, std::abs(now.area_drift), std::abs(now.volume_drift)});
    }
    observer.status({evolution.state().step, 0.0, evolution.state().time, events.end_time, step.dt, drift, elapsed()});
  }
  run.rows.push_back(row_of(evolution.state(), evolution.evaluation()));
  run.n_steps = evolution.state().step;
  run.raw_drift = raw_area / events.end_time;
  run.seconds.push_back(elapsed());
}

void run_to(const Scene& scene, const EventTimes& events, int repeats, TimedRun& run, BenchObserver& observer) {
  while (wants_repeat(run.seconds, repeats)) run_once(scene, events, run, observer);
}

TimedRun fixed_run(Scene scene, double dt, int time_order, double at, int repeats, BenchObserver& observer) {
  scene.numerics.tolerance.reset();
  scene.numerics.dt = dt;
  scene.numerics.time_order = time_order;
  TimedRun run{fmt::format("order {}", time_order), fmt::format("{:g}", dt), dt};
  run_to(scene, {{}, at}, repeats, run, observer);
  return run;
}

TimedRun adaptive_run(const TimeTask& task, double tolerance, BenchObserver& observer) {
  Scene asked = at_tolerance(task.scene, tolerance);
  asked.numerics.end_time = task.at;
  TimedRun run{"tolerance", fmt::format("{:.0e}", tolerance), {}, tolerance};
  run_to(asked, {task.snapshots, task.at}, task.repeats, run, observer);
  return run;
}

/// Largest difference of one quantity in the rows that both runs have, over all vesicles, relative to its largest value
/// there; differences of angles are in radians.
double relative_error(const Quantity& quantity, const TimedRun& run, const TimedRun& reference) {
  constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
  constexpr double kSameTime = 1e-9;
  const bool is_angle = quantity.member == &VesicleDiagnostics::inclination_deg;
  double difference = 0.0, size = is_angle ? kDegreesPerRadian : 0.0;
  for (auto row = run.rows.begin(), other = reference.rows.begin();
       row != run.rows.end() && other != reference.rows.end();) {
    if (std::abs(row->time - other->time) > kSameTime * reference.rows.back().time) {
      ++(row->time < other->time ? row : other);
      continue;
    }
    for (std::size_t a = 0; a < other->vesicles.size(); ++a) {
      const double value = other->vesicles[a].*quantity.member;
      const double here = std::abs(row->vesicles[a].*quantity.member - value);
      difference = std::max(difference, is_angle ? std::min(here, 180.0 - here) : here);
      if (!is_angle) size = std::max(size, std::abs(value));
    }
    ++row, ++other;
  }
  return difference == 0.0 ? 0.0 : difference / size;
}

BenchTable empty_time_table() {
  BenchTable table{"rows",
                   {{"integrator", "integrator", "{}", false, 20},
                    {"setting", "dt, tolerance"},
                    {"dt", ""},
                    {"tolerance", ""},
                    {"seconds", "seconds", "{:.2g}", true},
                    {"steps", "steps"},
                    {"order", "degree"},
                    {"error", "error", "{:.1e}"},
                    {"error_in_time", "in time alone", "{:.1e}"},
                    {"error_over_tolerance", "error/tolerance", "{:.2f}"},
                    {"raw_drift", "raw drift", "{:.1e}"}}};
  for (const Quantity& quantity : kQuantities) table.columns.push_back({std::string("error_") + quantity.name, ""});
  for (const Quantity& quantity : kQuantities) table.columns.push_back({quantity.name, ""});
  return table;
}

/// Errors of all quantities, in their order.
std::vector<double> errors_of(const TimedRun& run, const TimedRun& reference) {
  std::vector<double> errors;
  for (const Quantity& quantity : kQuantities) {
    errors.push_back(relative_error(quantity, run, reference));
  }
  return errors;
}

/// Value at the end, of the first vesicle.
double final_value(const Quantity& quantity, const TimedRun& run) {
  return run.rows.back().vesicles.front().*quantity.member;
}

/// Runs from which errors are taken.
struct References {
  const TimedRun& best;
  const TimedRun* same_degree;  ///< with far smaller steps; nullptr: none
};

std::vector<BenchCell> row_of(const TimedRun& run, const References& references) {
  const std::vector<double> errors = errors_of(run, references.best);
  BenchCell error, in_time, over_tolerance;
  // The error of the reference is unknown.
  if (&run != &references.best) {
    error = std::ranges::max(errors);
    if (const double* tolerance = std::get_if<double>(&run.tolerance))
      over_tolerance = std::ranges::max(errors) / *tolerance;
  }
  // Runs with a tolerance have no fixed degree.
  if (references.same_degree != nullptr && references.same_degree != &run && std::holds_alternative<double>(run.dt)) {
    in_time = std::ranges::max(errors_of(run, *references.same_degree));
  }
  std::vector<BenchCell> row{run.integrator,
                             run.setting,
                             run.dt,
                             run.tolerance,
                             spread_of(run.seconds),
                             run.n_steps,
                             std::int64_t{run.highest_order},
                             error,
                             in_time,
                             over_tolerance,
                             run.raw_drift};
  row.insert(row.end(), errors.begin(), errors.end());
  for (const Quantity& quantity : kQuantities) row.emplace_back(final_value(quantity, run));
  return row;
}

std::vector<Quantity> shown_quantities() {
  std::vector<Quantity> shown;
  std::ranges::copy_if(kQuantities, std::back_inserter(shown), &Quantity::shown);
  return shown;
}

/// Adds the values at each step size of one integrator, and the order and the limit estimated from the last three.
void add_values(BenchTable& table, const std::vector<TimedRun>& runs, BenchObserver& observer) {
  for (const TimedRun& run : runs) {
    std::vector<BenchCell> row{run.integrator, run.setting};
    for (const Quantity& quantity : shown_quantities()) row.emplace_back(final_value(quantity, run));
    add_row(table, std::move(row), observer);
  }
  if (runs.size() < 3) return;
  std::vector<BenchCell> orders{runs.front().integrator, "observed order"};
  std::vector<BenchCell> limits{runs.front().integrator, "dt → 0"};
  for (const Quantity& quantity : shown_quantities()) {
    const auto value = [&](std::size_t from_end) { return final_value(quantity, runs[runs.size() - from_end]); };
    const double coarse = value(3), middle = value(2), fine = value(1);
    const double ratio = (coarse - middle) / (middle - fine);
    // Values that do not change monotonically, or not at all, have no observed order.
    const bool converging = std::isfinite(ratio) && ratio > 1.0 && std::abs(middle - fine) > 1e-9 * std::abs(fine);
    orders.emplace_back();
    limits.emplace_back();
    if (converging) {
      orders.back() = std::log2(ratio);
      limits.back() = fine + (fine - middle) / (ratio - 1.0);
    }
  }
  add_row(table, std::move(orders), observer);
  add_row(table, std::move(limits), observer);
}

BenchTable values_table() {
  BenchTable table{"values", {{"integrator", "integrator", "{}", false, 20}, {"setting", "dt", "{}", false, 14}}};
  for (const Quantity& quantity : shown_quantities()) {
    table.columns.push_back({quantity.name, quantity.name, "{:.6g}"});
  }
  return table;
}

/// Error of the steps only for fixed steps, the whole error with a tolerance; nothing if it is unknown.
std::optional<double> error_of_integrator(const TimedRun& run, const References& references) {
  const bool is_fixed = std::holds_alternative<double>(run.dt);
  const TimedRun* reference = is_fixed ? references.same_degree : &references.best;
  if (reference == nullptr || reference == &run) return {};
  const double error = std::ranges::max(errors_of(run, *reference));
  return error > 0.0 ? std::optional(error) : std::nullopt;
}

BenchTable empty_digits_table() {
  return {"digits",
          {{"integrator", "integrator", "{}", false, 20},
           {"error_largest", "errors from", "{:.1e}", false, 12},
           {"error_smallest", "to", "{:.1e}"},
           {"seconds_of_a_digit", "one more digit multiplies the seconds by", "{:.2g}"}}};
}

/// Cost of one more digit, from the power law through all runs of an integrator with a known error; empty if there are
/// fewer than three, or if seconds do not grow as errors fall.
std::vector<BenchCell> digits_row(const std::vector<TimedRun>& runs, const References& references) {
  std::vector<double> errors, seconds;
  for (const TimedRun& run : runs) {
    const std::optional<double> error = error_of_integrator(run, references);
    if (!error) continue;
    errors.push_back(*error);
    seconds.push_back(spread_of(run.seconds).median);
  }
  if (errors.size() < 3) return {};
  const auto [smallest, largest] = std::ranges::minmax(errors);
  const double exponent = smallest < largest ? fitted_exponent(errors, seconds) : 0.0;
  if (exponent >= 0.0) return {};
  return {runs.front().integrator, largest, smallest, std::pow(10.0, -exponent)};
}

void require_falling(const TimeTask& task) {
  for (std::size_t i = 1; i < task.steps.size(); ++i) {
    if (std::abs(task.steps[i] - 0.5 * task.steps[i - 1]) > 1e-12 * task.steps[i - 1]) {
      throw InputError(fmt::format("--dt: {} is not half of {}", task.steps[i], task.steps[i - 1]));
    }
  }
  for (std::size_t i = 1; i < task.tolerances.size(); ++i) {
    if (!(task.tolerances[i] < task.tolerances[i - 1])) {
      throw InputError(fmt::format("--tolerance: {} is not below {}", task.tolerances[i], task.tolerances[i - 1]));
    }
  }
}

TimedRun reference_of_steps(const TimeTask& task, const std::vector<int>& time_orders, BenchObserver& observer) {
  constexpr int kLowOrder = 2;
  const bool high = *std::max_element(time_orders.begin(), time_orders.end()) > kLowOrder;
  const double dt = high ? 0.5 * task.steps.back() : task.steps[task.steps.size() / 2];
  return fixed_run(task.scene, dt, highest_time_order, task.at, 1, observer);
}

}  // namespace

BenchResult bench_time(const TimeTask& task, BenchObserver& observer) {
  require_falling(task);
  std::vector<int> time_orders = task.time_orders;
  if (time_orders.empty()) time_orders.push_back(task.scene.numerics.time_order);
  if (task.steps.empty()) time_orders.clear();
  std::vector<std::vector<TimedRun>> runs;
  for (const int order : time_orders) {
    std::vector<TimedRun>& of_order = runs.emplace_back();
    for (const double dt : task.steps)
      of_order.push_back(fixed_run(task.scene, dt, order, task.at, task.repeats, observer));
  }
  std::optional<TimedRun> same_degree;
  if (!task.steps.empty()) same_degree = reference_of_steps(task, time_orders, observer);
  if (!task.tolerances.empty()) {
    std::vector<TimedRun>& adaptive = runs.emplace_back();
    for (const double tolerance : task.tolerances) {
      adaptive.push_back(adaptive_run(task, tolerance, observer));
    }
  } else {
    runs.push_back({*same_degree});
    runs.back().front().integrator = "reference (" + runs.back().front().integrator + ")";
  }
  const References references{runs.back().back(), task.tolerances.empty() ? &runs.back().back()
                                                  : same_degree           ? &*same_degree
                                                                          : nullptr};
  const TimedRun& reference = references.best;

  BenchResult result{"time", machine_record(), task.repeats, {}, {empty_time_table()}};
  result.facts = {{"time", task.at},
                  {"order", task.scene.numerics.order},
                  {"reference", reference.integrator + " " + reference.setting}};
  observer.note(fmt::format("time {}, errors against {} {}", task.at, reference.integrator, reference.setting));
  observer.heading(result.tables.front());
  for (const auto& of_integrator : runs) {
    for (const TimedRun& run : of_integrator) add_row(result.tables.front(), row_of(run, references), observer);
  }
  if (!task.steps.empty()) {
    result.tables.push_back(values_table());
    observer.heading(result.tables.back());
    for (std::size_t i = 0; i < time_orders.size(); ++i) add_values(result.tables.back(), runs[i], observer);
  }
  std::vector<std::vector<BenchCell>> digits;
  for (const auto& of_integrator : runs) {
    if (std::vector<BenchCell> row = digits_row(of_integrator, references); !row.empty()) digits.push_back(row);
  }
  if (digits.empty()) return result;
  result.tables.push_back(empty_digits_table());
  observer.heading(result.tables.back());
  for (std::vector<BenchCell>& row : digits) add_row(result.tables.back(), std::move(row), observer);
  return result;
}

}  // namespace vehd
