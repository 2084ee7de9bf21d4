#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "bie/bench/benches.hpp"
#include "bie/bench/step_timer.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/memory.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

std::string key_of(std::string part) {
  std::replace(part.begin(), part.end(), ' ', '_');
  return part;
}

BenchTable empty_parts_table(const std::vector<std::string>& parts) {
  BenchTable table{"rows", {{"order", "p"}, {"first_step_seconds", "first step", "{:.2g}", true}}};
  for (const std::string& part : parts) table.columns.push_back({"seconds_" + key_of(part), part, "{:.2g}", true});
  table.columns.push_back({"iterations_flow", "iterations", "{:.0f}", true});
  for (const std::string& part : parts) table.columns.push_back({"bytes_" + key_of(part), ""});
  table.columns.push_back({"peak_memory_bytes", ""});
  return table;
}

}  // namespace

BenchResult bench_parts(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer) {
  scene = with_fixed_steps(std::move(scene), "parts");
  require_ascending("--degrees", orders);
  BenchResult result{"parts", machine_record(), repeats, {}, {}};
  result.facts = {{"dt", *scene.numerics.dt},
                  {"time_order", scene.numerics.time_order},
                  {"bytes_are", "peak memory beyond that at the start of the part"}};
  observer.note(fmt::format("{} threads, dt = {}; seconds", result.machine.threads, *scene.numerics.dt));
  BenchTasks tasks(static_cast<int>(orders.size()) * (repeats + 2), observer);
  std::vector<std::string> parts;
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
    std::vector<BenchCell> row{std::int64_t{order}, spread_of(first)}, byte_cells;
    for (const std::string& part : parts) {
      row.emplace_back(spread_of(timer.seconds().at(part)));
      byte_cells.emplace_back();
      const auto bytes = timer.bytes().find(part);
      if (bytes != timer.bytes().end() && bytes->second > 0) byte_cells.back() = bytes->second;
    }
    row.emplace_back(spread_of(timer.iterations()));
    row.insert(row.end(), byte_cells.begin(), byte_cells.end());
    row.emplace_back(peak_memory_bytes());
    add_row(result.tables.front(), std::move(row), observer);
  }
  return result;
}

namespace {

BenchTable empty_symmetry_table() {
  return {"rows",
          {{"order", "p"},
           {"seconds_full", "full solver", "{:.2g}", true},
           {"seconds", "with symmetry", "{:.2g}", true},
           {"ratio", "ratio", "{:.1f}"},
           {"kernel_ratio", "", "{:.1f}"},
           {"steps", "steps"},
           {"difference", "difference", "{:.0e}"}}};
}

Scene with_symmetry(Scene scene, SymmetryUse use) {
  scene.numerics.symmetry = use;
  return scene;
}

}  // namespace

BenchResult bench_symmetry(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer) {
  scene = with_fixed_steps(std::move(scene), "symmetry");
  require_ascending("--degrees", orders);
  if (!problem_of(with_symmetry(scene, SymmetryUse::automatic)).symmetry.any()) {
    throw InputError("bench symmetry needs a scene that has one");
  }
  BenchResult result{"symmetry", machine_record(), repeats, {}, {empty_symmetry_table()}};
  result.facts = {{"dt", *scene.numerics.dt},
                  {"difference_is", "of x and V_m after the same steps, over the largest coefficient"}};
  BenchTable& table = result.tables.front();
  observer.heading(table);
  BenchTasks tasks(static_cast<int>(orders.size()) * (repeats + 1), observer);
  for (const int order : orders) {
    scene.numerics.order = order;
    tasks.next(fmt::format("p = {}: first steps", order));
    StepTimer full(with_symmetry(scene, SymmetryUse::off)), reduced(with_symmetry(scene, SymmetryUse::automatic));
    for (int i = 0; i < repeats; ++i) {
      tasks.next(fmt::format("p = {}: step {} of {}", order, i + 1, repeats));
      full.timed_step();
      reduced.timed_step();
    }
    const Spread of_full = spread_of(full.seconds().at("step")), of_reduced = spread_of(reduced.seconds().at("step"));
    add_row(table,
            {std::int64_t{order}, of_full, of_reduced, of_full.median / of_reduced.median,
             double(full.kernel_evaluations()) / double(reduced.kernel_evaluations()), std::int64_t{full.state().step},
             state_difference(reduced.state(), full.state())},
            observer);
  }
  return result;
}

namespace {

BenchTable empty_threads_table(int first_count) {
  return {"rows",
          {{"part", "part", "{}", false, 18},
           {"threads", "threads"},
           {"seconds", "seconds", "{:.2g}", true},
           {"speed_up", fmt::format("speed-up over {}", first_count), "{:.2f}"},
           {"efficiency", "efficiency", "{:.2f}"},
           {"difference", "difference", "{:.0e}"}}};
}

}  // namespace

std::vector<int> thread_counts() {
  const int most = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  std::vector<int> counts;
  for (int count = 1; count < most; count *= 2) counts.push_back(count);
  counts.push_back(most);
  return counts;
}

BenchResult bench_threads(Scene scene, const std::vector<int>& counts, int repeats, BenchObserver& observer) {
  scene = with_fixed_steps(std::move(scene), "threads");
  require_ascending("--threads", counts);
  std::vector<std::unique_ptr<StepTimer>> timers;
  BenchTasks tasks(static_cast<int>(counts.size()) * (repeats + 1), observer);
  for (const int count : counts) {
    const ThreadCount threads(count);
    tasks.next(fmt::format("{} threads: first steps", count));
    timers.push_back(std::make_unique<StepTimer>(scene));
  }
  for (int i = 0; i < repeats; ++i) {
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const ThreadCount threads(counts[k]);
      tasks.next(fmt::format("{} threads: step {} of {}", counts[k], i + 1, repeats));
      timers[k]->timed_step();
    }
  }

  BenchResult result{"threads", machine_record(), repeats, {}, {empty_threads_table(counts.front())}};
  result.facts = {{"order", scene.numerics.order},
                  {"dt", *scene.numerics.dt},
                  {"difference_is", "of x and V_m after the same steps from the first count, over the largest"}};
  BenchTable& table = result.tables.front();
  observer.note(fmt::format("p = {}", scene.numerics.order));
  observer.heading(table);
  const auto add_part = [&](const std::string& part) {
    const double first = spread_of(timers.front()->seconds().at(part)).median;
    for (std::size_t k = 0; k < counts.size(); ++k) {
      const Spread seconds = spread_of(timers[k]->seconds().at(part));
      const double speed_up = first / seconds.median;
      BenchCell deviation;
      if (part == "step") deviation = state_difference(timers[k]->state(), timers.front()->state());
      add_row(table,
              {part, std::int64_t{counts[k]}, seconds, speed_up, speed_up * counts.front() / counts[k], deviation},
              observer);
    }
  };
  for (const std::string& part : timers.front()->parts()) add_part(part);
  return result;
}

}  // namespace vehd
