#include "bie/estimate/stretch.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

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
  Deadline* deadline;

  TwoTolerances(const Scene& scene, double loose_tolerance, double tight_tolerance, Deadline* of_all)
      : loose_scene(at_tolerance(scene, loose_tolerance)),
        tight_scene(at_tolerance(scene, tight_tolerance)),
        loose(problem_of(loose_scene)),
        tight(problem_of(tight_scene)),
        events(events_of(tight_scene)),
        deadline(of_all) {}

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
  Instruments instruments(two.deadline);
  Evolution evolution(setup, std::move(state), instruments);
  evolution.evaluate_start();
  evolution.step(two.events);
  // What it remembers is as wrong as its tolerance allows.
  State result = without_past(evolution.state());
  raise_to(order, result);
  result.dt_next *= two.expected_factor();
  return result;
}

/// Size of the step of the trial run so much time after the beginning of one.
double loose_size(const TrialRun& trial, std::size_t step, double after) {
  std::size_t i = std::min(step, trial.steps.size() - 1);
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

/// One with the tight tolerance.
struct TightStep {
  double begin = 0.0;  // after that of the stretch
  double dt = 0.0;
  int order = 0;
  int tries = 1;
  int evaluations = 0;
  int moments = 0;
  bool begins_with_past = false;
  double seconds = 0.0;
};

std::vector<TightStep> take_tight_steps(Evolution& evolution, const EventTimes& events) {
  std::vector<TightStep> steps;
  const double begin = evolution.state().time;
  while (std::ssize(steps) + 1 < steps_of_stretch && evolution.state().time < events.end_time) {
    TightStep taken{.begin = evolution.state().time - begin,
                    .begins_with_past = evolution.state().past_times.size() > 0};
    const auto start = std::chrono::steady_clock::now();
    const StepAttempt step = evolution.step(events);
    taken.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    taken.dt = step.dt;
    taken.order = highest_order_of(evolution.state());
    taken.tries += step.rejected;
    taken.evaluations = step.evaluations;
    taken.moments = static_cast<int>(evolution.passed().size());
    steps.push_back(taken);
  }
  return steps;
}

/// Compares the sizes of the tight steps and of the next one with those of the loose ones at the same times.
/// @param steps    one at least
/// @param next_dt  that they tell
/// @param first    step of the trial run in whose place they begin
Stretch compared(const std::vector<TightStep>& steps, double next_dt, const TrialRun& trial, std::size_t first) {
  Stretch stretch{.step = first};
  double tight = next_dt;
  double loose = loose_size(trial, first, steps.back().begin + steps.back().dt + 0.5 * next_dt);
  double evaluations = 0.0, tries = 0.0, with_past = 0.0;
  // The first ones go on from a guess of a size, no past and nothing recycled, and see what the loose step has left die
  // away. A scene's start has no loose step, and its motions are gone soon.
  constexpr std::size_t kTelling = 2;
  const std::size_t told =
      first > 0 ? steps.size() - std::min(kTelling, steps.size()) : std::min<std::size_t>(1, steps.size() - 1);
  for (std::size_t i = told; i < steps.size(); ++i) {
    const TightStep& step = steps[i];
    tight += step.dt;
    loose += loose_size(trial, first, step.begin + 0.5 * step.dt);
    evaluations += step.evaluations - step.moments;
    tries += step.tries;
    with_past += step.begins_with_past ? 1.0 : 0.0;
    stretch.timed.push_back({step.order, step.evaluations, step.seconds});
  }
  stretch.steps_for_one = loose / tight;
  stretch.evaluations = evaluations / tries;
  stretch.share_with_past = with_past / static_cast<double>(steps.size() - told);
  return stretch;
}

/// Tight steps in place of that one of the trial run and of those after it; nothing where there is no time for one.
/// @param evolution  at its start
/// @param order      degree that is expected there
std::optional<Stretch> stretch_at(std::size_t step, Evolution& evolution, const TwoTolerances& two,
                                  const TrialRun& trial, int order) {
  if (step >= trial.steps.size() || two.is_over(evolution.state())) return std::nullopt;
  evolution.evaluate_start();
  order = std::max(order, highest_order_of(evolution.state()));
  const std::vector<TightStep> steps = take_tight_steps(evolution, two.events);
  Stretch stretch = compared(steps, evolution.state().dt_next, trial, step);
  stretch.more_degrees = std::max(0, std::ranges::max(steps, {}, &TightStep::order).order - order);
  return stretch;
}

/// The start of a scene has nothing that is to be filled.
std::optional<Stretch> stretch_at_start(const TwoTolerances& two, const TrialRun& trial, int order) {
  Instruments instruments(two.deadline);
  Evolution evolution(setup_of(two.tight), two.tight.start, instruments);
  return stretch_at(0, evolution, two, trial, order);
}

std::optional<Stretch> stretch_from(const TrialState& from, const TwoTolerances& two, const TrialRun& trial,
                                    int order) {
  Instruments instruments(two.deadline);
  Evolution evolution(setup_of(two.tight), filled(two, from.state, order), instruments);
  return stretch_at(from.step + 1, evolution, two, trial, order);
}

}  // namespace

std::vector<Stretch> take_stretches(const Scene& scene, const TrialRun& trial, double tolerance, std::size_t count,
                                    const std::vector<int>& orders, const std::function<bool()>& begins,
                                    Deadline* deadline) {
  const TwoTolerances two(scene, trial.tolerance, tolerance, deadline);
  std::vector<Stretch> stretches;
  const auto add = [&](const auto& taken) {
    if (!begins()) return;
    try {
      if (std::optional<Stretch> stretch = taken()) stretches.push_back(std::move(*stretch));
    } catch (const ConvergenceError&) {
      // A step that fails says nothing of others.
    } catch (const OutOfTime&) {
      // Those before it tell.
    }
  };
  count = std::min(count, trial.states.size());
  const auto add_part = [&](std::size_t k) {
    const TrialState& from = trial.states[place_in_part(trial, k, count)];
    if (from.step < trial.steps.size()) add([&] { return stretch_from(from, two, trial, orders[from.step]); });
  };
  // Every other one first: where time runs out, these tell of the whole run.
  for (std::size_t k = 0; k < count; k += 2) add_part(k);
  add([&] { return stretch_at_start(two, trial, orders.front()); });
  for (std::size_t k = 1; k < count; k += 2) add_part(k);
  std::ranges::sort(stretches, {}, &Stretch::step);
  return stretches;
}

}  // namespace vehd
