#include "bie/app/pilot.hpp"

#include <algorithm>
#include <chrono>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/problem.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/stepping/resolution.hpp"

namespace vehd {

Pilot run_pilot(const Scene& scene, double tolerance, const std::vector<double>& tolerances, double seconds) {
  const auto start = std::chrono::steady_clock::now();
  const auto spent = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  const Scene asked = at_tolerance(scene, tolerance);
  const Problem problem = problem_of(asked);
  Instruments instruments;
  Evolution evolution(setup_of(problem), problem.position, problem.steady_potential, instruments);
  evolution.evaluate_start();
  Pilot pilot;
  pilot.tolerance = tolerance;
  pilot.time_order = asked.numerics.time_order;
  pilot.highest_order = evolution.order();
  const double end = asked.numerics.end_time;
  while (evolution.state().time < end && (pilot.steps.empty() || spent() < seconds)) {
    const EvolutionStep step = evolution.step({asked.output.every, end});
    PilotStep record{evolution.state().time, step.dt,          step.change, step.rejected + 1,
                     evolution.order(),      step.at_snapshot, {}};
    pilot.highest_order = std::max(pilot.highest_order, evolution.order());
    const Resolution resolution(problem.model, evolution.state());
    for (const double wanted : tolerances) {
      record.orders.push_back(
          resolution.order_for(truncation_share * wanted, lowest_adaptive_order, accuracy_defaults(wanted).order));
    }
    pilot.steps.push_back(std::move(record));
  }
  pilot.completed = evolution.state().time >= end;
  pilot.seconds = spent();
  return pilot;
}

}  // namespace vehd
