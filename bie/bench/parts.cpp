#include <fmt/format.h>

#include <algorithm>

#include "bie/bench/benches.hpp"
#include "bie/bench/step_timer.hpp"
#include "bie/support/machine_peak.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

/// Everything known about one part.
struct PartCurve {
  std::vector<double> orders, seconds, memory_orders, bytes;
  double operations = 0.0;
};

std::string key_of(std::string part) {
  std::replace(part.begin(), part.end(), ' ', '_');
  return part;
}

BenchTable empty_parts_table(const std::vector<std::string>& parts) {
  BenchTable table{"rows", {{"order", "p"}, {"first_step_seconds", "first step", "{:.2g}", true}}};
  for (const std::string& part : parts) table.columns.push_back({"seconds_" + key_of(part), part, "{:.2g}", true});
  table.columns.push_back({"iterations_flow", "iterations", "{:.0f}", true});
  for (const std::string& part : parts) table.columns.push_back({"bytes_" + key_of(part), ""});
  for (const std::string& part : parts) table.columns.push_back({"peak_fraction_" + key_of(part), ""});
  table.columns.push_back({"peak_memory_bytes", ""});
  return table;
}

BenchCell exponent(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return {};
  return fitted_exponent(x, y);
}

BenchTable growth_table(const std::vector<std::string>& parts, const std::map<std::string, PartCurve>& curves,
                        double peak, BenchObserver& observer) {
  BenchTable table{"growth",
                   {{"part", "part", "{}", false, 18},
                    {"exponent_seconds", "seconds grow like p^", "{:.1f}"},
                    {"exponent_bytes", "memory grows like p^", "{:.1f}"},
                    {"order", "at p ="},
                    {"seconds", "seconds", "{:.2g}"},
                    {"bytes", ""},
                    {"megabytes", "MB", "{:.0f}"},
                    {"peak_fraction", "share of peak", "{:.2f}"}}};
  observer.heading(table);
  for (const std::string& part : parts) {
    const PartCurve& curve = curves.at(part);
    BenchCell bytes, megabytes, fraction;
    if (!curve.bytes.empty()) {
      bytes = static_cast<std::int64_t>(curve.bytes.back());
      megabytes = curve.bytes.back() / 1e6;
    }
    if (curve.operations > 0.0) fraction = curve.operations / curve.seconds.back() / peak;
    add_row(table,
            {part, exponent(curve.orders, curve.seconds), exponent(curve.memory_orders, curve.bytes),
             static_cast<std::int64_t>(curve.orders.back()), curve.seconds.back(), bytes, megabytes, fraction},
            observer);
  }
  return table;
}

}  // namespace

BenchResult bench_parts(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer) {
  scene = with_fixed_steps(std::move(scene), "parts");
  require_ascending("--degrees", orders);
  const MachineRecord machine = machine_record();
  const double peak = measured_peak(machine.threads);
  BenchResult result{"parts", machine, repeats, {}, {}};
  result.facts = {{"dt", *scene.numerics.dt},
                  {"time_order", scene.numerics.time_order},
                  {"peak_operations_per_second", peak},
                  {"peak_is_of", "products of matrices of 256 rows in double precision"},
                  {"bytes_are", "peak memory beyond that at the start of the part"}};
  observer.note(fmt::format("{} threads, {:.1f} Gflop/s in matrix products, dt = {}; seconds", machine.threads,
                            peak / 1e9, *scene.numerics.dt));
  BenchTasks tasks(static_cast<int>(orders.size()) * (repeats + 2), observer);
  std::vector<std::string> parts;
  std::map<std::string, PartCurve> curves;
  for (const int order : orders) {
    scene.numerics.order = order;
    tasks.next(fmt::format("p = {}: first step", order));
    std::vector<double> first;
    while (wants_repeat(first, repeats)) first.push_back(seconds_to_the_first_step(scene));
    tasks.next(fmt::format("p = {}: memory", order));
    StepTimer timer(scene);
    timer.metered_step();
    for (int i = 0; i < repeats; ++i) {
      tasks.next(fmt::format("p = {}: step {} of {}", order, i + 1, repeats));
      timer.timed_step();
    }
    if (parts.empty()) {
      parts = timer.parts();
      result.tables.push_back(empty_parts_table(parts));
      observer.heading(result.tables.front());
    }
    const std::map<std::string, double> operations = timer.operations();
    std::vector<BenchCell> seconds_cells, byte_cells, fraction_cells;
    for (const std::string& part : parts) {
      PartCurve& curve = curves[part];
      const Spread seconds = spread_of(timer.seconds().at(part));
      seconds_cells.emplace_back(seconds);
      curve.orders.push_back(order);
      curve.seconds.push_back(seconds.median);
      const auto bytes = timer.bytes().find(part);
      byte_cells.emplace_back();
      if (bytes != timer.bytes().end() && bytes->second > 0) {
        byte_cells.back() = bytes->second;
        curve.memory_orders.push_back(order);
        curve.bytes.push_back(static_cast<double>(bytes->second));
      }
      const auto counted = operations.find(part);
      curve.operations = counted == operations.end() ? 0.0 : counted->second;
      fraction_cells.emplace_back();
      if (curve.operations > 0.0) fraction_cells.back() = curve.operations / seconds.median / peak;
    }
    std::vector<BenchCell> row{std::int64_t{order}, spread_of(first)};
    seconds_cells.emplace_back(spread_of(timer.iterations()));
    for (const auto* cells : {&seconds_cells, &byte_cells, &fraction_cells}) {
      row.insert(row.end(), cells->begin(), cells->end());
    }
    row.emplace_back(peak_memory_bytes());
    add_row(result.tables.front(), std::move(row), observer);
  }
  result.tables.push_back(growth_table(parts, curves, peak, observer));
  return result;
}

}  // namespace vehd
