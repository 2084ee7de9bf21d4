#include "bie/estimate/stretch.hpp"

#include <algorithm>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/state/resized.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

int degree_of(const VesicleState& vesicle) { return order_of(vesicle.position.rows()); }

/// The vesicle with the highest degree gets that one, and others as many more.
void raise_to(int order, State& state) {
  const int more = order - highest_order_of(state);
  if (more <= 0) return;
  for (VesicleState& vesicle : state.vesicles) vesicle = resized(std::move(vesicle), degree_of(vesicle) + more);
}

/// A scene at two tolerances.
struct TwoTolerances {
  Scene loose_scene, tight_scene;
  Problem loose, tight;
  EventTimes events;

  TwoTolerances(const Scene& scene, double loose_tolerance, double tight_tolerance)
      : loose_scene(at_tolerance(scene, loose_tolerance)),
        tight_scene(at_tolerance(scene, tight_tolerance)),
        loose(problem_of(loose_scene)),
        tight(problem_of(tight_scene)),
        events(events_of(tight_scene)) {}

  [[nodiscard]] bool is_over(const State& state) const { return state.time >= events.end_time; }
  /// By which a step with the tight tolerance is shorter, if its order is all that it depends on.
  [[nodiscard]] double expected_factor() const {
    return std::pow(tight.control.tolerance / loose.control.tolerance, 1.0 / tight.settings.time_order);
  }
};

/// One step with the loose tolerance in the degrees of the tight one.
State filled(const TwoTolerances& two, State state, int order) {
  raise_to(order, state);
  EvolutionSetup setup = setup_of(two.loose);
  setup.settings.order = two.tight.settings.order;
  Instruments instruments;
  Evolution evolution(setup, std::move(state), instruments);
  evolution.evaluate_start();
  evolution.step(two.events);
  State result = evolution.state();
  raise_to(order, result);
  return result;
}

/// Size of the step of the trial run so much time after one, which is taken again.
double loose_size(const TrialRun& trial, std::size_t step, double after) {
  std::size_t i = std::min(step + 1, trial.steps.size() - 1);
  for (; i + 1 < trial.steps.size() && after > trial.steps[i].dt; ++i) after -= trial.steps[i].dt;
  return trial.steps[i].dt;
}

/// Whether no snapshot lies in the step from a state or in the two after it: those before and after one are shorter.
bool is_undisturbed(const TrialRun& trial, std::size_t step) {
  const auto first = trial.steps.begin() + static_cast<std::ptrdiff_t>(std::min(step, trial.steps.size()));
  const auto last = trial.steps.begin() + static_cast<std::ptrdiff_t>(std::min(step + 3, trial.steps.size()));
  return std::all_of(first, last, [](const TrialStep& taken) { return taken.moments == 0; });
}

/// Whether snapshots are so rare that it is chance whether one disturbs a stretch; where they are not, what they do
/// belongs to the run.
bool has_rare_snapshots(const TrialRun& trial) {
  constexpr double kRare = 0.25;
  const auto n = std::ranges::count_if(trial.steps, [](const TrialStep& step) { return step.moments > 0; });
  return static_cast<double>(n) <= kRare * static_cast<double>(trial.steps.size());
}

/// Of as many parts of the states, the middle of that part, or an undisturbed one near it where snapshots are rare.
std::size_t place_in_part(const TrialRun& trial, std::size_t part, std::size_t count) {
  const std::size_t n = trial.states.size();
  const std::size_t first = part * n / count, last = (part + 1) * n / count, middle = (2 * part + 1) * n / (2 * count);
  if (!has_rare_snapshots(trial)) return middle;
  for (std::size_t away = 0; away <= n / count; ++away) {
    for (const std::size_t place : {middle + away, middle - std::min(away, middle)}) {
      if (place >= first && place < last && is_undisturbed(trial, trial.states[place].step)) return place;
    }
  }
  return middle;
}

/// Takes the tight steps, and compares the size of the last one and of the next with those of the loose ones at the
/// same times.
/// @returns whether there was time for one
bool take_tight_steps(const TwoTolerances& two, State state, const TrialRun& trial, Stretch& stretch) {
  if (two.is_over(state)) return false;
  const double begin = state.time;
  state.dt_next *= two.expected_factor();
  Instruments instruments;
  Evolution evolution(setup_of(two.tight), std::move(state), instruments);
  evolution.evaluate_start();
  const int first_order = highest_order_of(evolution.state());
  int highest = first_order;
  double last_dt = 0.0;
  for (int i = 1; i < steps_of_stretch && !two.is_over(evolution.state()); ++i) {
    stretch.begins_with_past = evolution.state().past.is_continued == 1;
    const StepAttempt step = evolution.step(two.events);
    const auto moments = static_cast<int>(evolution.passed().size());
    const int order = highest_order_of(evolution.state());
    highest = std::max(highest, order);
    // Of the last one: the size of the first was a guess.
    last_dt = step.dt;
    stretch.evaluations = static_cast<double>(step.evaluations - moments) / (1 + step.rejected);
  }
  stretch.more_degrees = highest - first_order;
  const double next_dt = evolution.state().dt_next, passed = evolution.state().time - begin;
  const double loose =
      loose_size(trial, stretch.step, passed - 0.5 * last_dt) + loose_size(trial, stretch.step, passed + 0.5 * next_dt);
  stretch.steps_for_one = loose / (last_dt + next_dt);
  return true;
}

}  // namespace

std::vector<Stretch> take_stretches(const Scene& scene, const TrialRun& trial, double tolerance, std::size_t count,
                                    const std::vector<int>& orders, const std::function<bool()>& in_budget) {
  const TwoTolerances two(scene, trial.tolerance, tolerance);
  std::vector<Stretch> stretches;
  count = std::min(count, trial.states.size());
  // Every other one first: where time runs out, these tell of the whole run.
  std::vector<std::size_t> parts;
  for (const std::size_t first : {0, 1}) {
    for (std::size_t k = first; k < count; k += 2) parts.push_back(k);
  }
  for (const std::size_t k : parts) {
    if (!in_budget()) break;
    const TrialState& from = trial.states[place_in_part(trial, k, count)];
    if (from.step >= trial.steps.size()) continue;
    Stretch stretch{.step = from.step};
    try {
      if (!take_tight_steps(two, filled(two, from.state, orders[from.step]), trial, stretch)) {
        continue;
      }
    } catch (const ConvergenceError&) {
      // A step that fails says nothing of others.
      continue;
    }
    stretches.push_back(std::move(stretch));
  }
  std::ranges::sort(stretches, {}, &Stretch::step);
  return stretches;
}

}  // namespace vehd
