#include "bie/estimate/trial_run.hpp"

#include <algorithm>
#include <chrono>
#include <optional>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/space/resolution.hpp"
#include "bie/stepping/state/resized.hpp"
#include "bie/stepping/thresholds.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

namespace {

std::vector<Resolution> resolutions_of(const Evolution& evolution) {
  std::vector<Resolution> resolutions;
  for (std::size_t a = 0; a < evolution.state().vesicles.size(); ++a) {
    resolutions.push_back(evolution.resolution(evolution.state(), a));
  }
  return resolutions;
}

/// Degree that a tolerance needs at a state, of the vesicle that needs most.
/// @param share  of the tolerance, that the degrees left out may make up
int order_for(double tolerance, double share, const std::vector<Resolution>& resolutions) {
  int order = 0;
  for (const Resolution& resolution : resolutions) {
    order = std::max(order, resolution.order_for(share * tolerance, lowest_adaptive_order, default_order(tolerance)));
  }
  return order;
}

State without_recycled(State state) {
  for (VesicleState& vesicle : state.vesicles) vesicle.recycled = {};
  return state;
}

/// Keeps states that are as many steps apart, the fewest that leave no more than those that may be kept.
class KeptStates {
 public:
  explicit KeptStates(std::vector<TrialState>& states) : states_(states) {}
  /// The state before that step.
  void offer(std::size_t step, const State& state) {
    constexpr std::size_t kMost = 32;
    if (step % stride_ != 0) return;
    if (states_.size() >= kMost) {
      stride_ *= 2;
      std::erase_if(states_, [this](const TrialState& kept) { return kept.step % stride_ != 0; });
      if (step % stride_ != 0) return;
    }
    states_.push_back({step, without_recycled(state)});
  }

 private:
  std::vector<TrialState>& states_;
  std::size_t stride_ = 1;
};

/// Calls work and adds the seconds that it takes.
template <typename Work>
void add_seconds(double& seconds, const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Takes steps to the end of the scene or as long as the budget lasts, one at least.
/// @throws ConvergenceError where none is acceptable; the trial run has those before it
template <typename InBudget>
void take_steps(const Scene& scene, const std::vector<double>& tolerances, const InBudget& in_budget,
                Deadline* deadline, TrialRun& trial) {
  const Problem problem = problem_of(scene);
  Instruments instruments(deadline);
  std::optional<Evolution> begun;
  add_seconds(trial.seconds, [&] {
    begun.emplace(setup_of(problem), problem.start, instruments);
    begun->evaluate_start();
  });
  Evolution& evolution = *begun;
  trial.highest_order = highest_order_of(evolution.state());
  const EventTimes events = events_of(scene);
  const double end = events.end_time;
  KeptStates kept(trial.states);
  while (evolution.state().time < end && (trial.steps.empty() || in_budget())) {
    kept.offer(trial.steps.size(), evolution.state());
    StepAttempt step;
    add_seconds(trial.seconds, [&] { step = evolution.step(events); });
    TrialStep record{evolution.state().time,
                     step.dt,
                     step.error_estimate,
                     step.evaluations,
                     step.rejected,
                     static_cast<int>(evolution.passed().size()),
                     highest_order_of(evolution.state()),
                     {},
                     {}};
    trial.highest_order = std::max(trial.highest_order, highest_order_of(evolution.state()));
    const std::vector<Resolution> resolutions = resolutions_of(evolution);
    for (const double wanted : tolerances) {
      const double share = thresholds::truncation_share / evolution.growth();
      record.orders.push_back(order_for(wanted, share, resolutions));
      record.idle_orders.push_back(order_for(wanted, thresholds::idle_truncation * share, resolutions));
    }
    trial.steps.push_back(std::move(record));
  }
  trial.completed = evolution.state().time >= end;
}

}  // namespace

TrialRun run_trial(const Scene& scene, double tolerance, const std::vector<double>& tolerances,
                   const TrialBudget& budget) {
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const Scene asked = at_tolerance(scene, tolerance);
  TrialRun trial;
  trial.tolerance = tolerance;
  const auto in_budget = [&] { return std::ssize(trial.steps) < budget.steps && spent() < budget.seconds; };
  try {
    take_steps(asked, tolerances, in_budget, budget.deadline, trial);
  } catch (const ConvergenceError& error) {
    trial.stops = error.what();
  } catch (const OutOfTime&) {
    // The steps before it count.
  }
  return trial;
}

int starting_order(const Scene& scene, double tolerance, Deadline* deadline) {
  const Scene asked = at_tolerance(scene, tolerance);
  const Problem problem = problem_of(asked);
  Instruments instruments(deadline);
  Evolution evolution(setup_of(problem), problem.start, instruments);
  evolution.evaluate_start();
  evolution.step(events_of(asked));
  return highest_order_of(evolution.state());
}

}  // namespace vehd
