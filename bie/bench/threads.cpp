#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "bie/bench/benches.hpp"
#include "bie/bench/step_timer.hpp"
#include "bie/stepping/state/state_difference.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
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
