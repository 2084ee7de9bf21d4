#include <fmt/format.h>

#include "bie/bench/benches.hpp"
#include "bie/bench/step_timer.hpp"
#include "bie/stepping/state/state_difference.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
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

}  // namespace vehd
