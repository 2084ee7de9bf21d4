#include "bie/runs/simulation.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/scene/waveforms.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/state/state.hpp"
#include "bie/support/ranks/parcel.hpp"

namespace vehd {
namespace {

StepAttempt attempt_of(const Evaluation& evaluation, bool at_snapshot) {
  StepAttempt none;
  none.iterations_flow = evaluation.iterations_flow;
  none.iterations_electric = evaluation.iterations_electric;
  none.at_snapshot = at_snapshot;
  return none;
}

}  // namespace

HistoryRow row_in_laboratory(const LabFrameOutput& laboratory, int order, const RecordedSide& side) {
  HistoryRow shown = side.row;
  shown.diagnostics = laboratory.is_rotated() ? laboratory.diagnostics(side.row.diagnostics, resized(side.state, order),
                                                                       resized(side.fields, order))
                                              : laboratory.diagnostics(side.row.diagnostics);
  return shown;
}

RunTotals Simulation::totals() const {
  RunTotals totals = from_.totals;
  totals.seconds += seconds();
  const auto add = [&](const std::map<std::string, std::uint64_t>& own, auto& sums) {
    for (const std::string& of_rank : ranks_.gather(packed(own))) {
      for (const auto& [name, count] : unpacked<std::map<std::string, std::uint64_t>>(of_rank)) sums[name] += count;
    }
  };
  add(instruments_.kernel_evaluations(), totals.kernel_evaluations);
  add(instruments_.pair_targets(), totals.pair_targets);
  for (const auto& [name, seconds] : instruments_.seconds()) totals.seconds_of_parts[name] += seconds;
  return totals;
}

Simulation::Simulation(const Scene& scene, Checkpoint from, OutputUnits units, Ranks ranks)
    : scene_(scene),
      from_(std::move(from)),
      units_(std::move(units)),
      time_unit_(units_.of("time")),
      problem_(problem_of(scene, start_order(), from_.origin ? &from_.origin->state : nullptr)),
      ranks_(std::move(ranks)),
      events_(events_of(scene)),
      evolution_(evolution_of_scene()),
      start_time_(evolution_.state().time) {}

int Simulation::start_order() const {
  return is_resumed() ? static_cast<int>(from_.start_order) : scene_.numerics.order;
}

Evolution Simulation::evolution_of_scene() {
  EvolutionSetup setup = setup_of(problem_);
  setup.ranks = ranks_;
  setup.time_text = [unit = time_unit_](double time) { return unit.text_of(time); };
  if (is_resumed()) return {std::move(setup), from_.state, instruments_};
  return {std::move(setup), problem_.start, instruments_};
}

void Simulation::start() {
  evolution_.evaluate_start();
  last_ = attempt_of(evolution_.evaluation(), true);
}

void Simulation::step(const EventTimes& events) {
  last_ = evolution_.step(events);
  // Rows need only the numbers of the attempt.
  last_.state = {};
  last_.dense_states.clear();
}

Checkpoint Simulation::checkpoint() const {
  Checkpoint checkpoint = from_;
  checkpoint.scene = effective_scene(scene_);
  checkpoint.state = evolution_.state();
  checkpoint.start_order = start_order();
  checkpoint.threads = omp_get_max_threads();
  return checkpoint;
}

RecordedSide Simulation::side_of(const State& state, const Evaluation& evaluation, const SmallestGap& gap,
                                 const StepAttempt& step) const {
  std::vector<int> orders;
  for (const VesicleState& vesicle : state.vesicles) orders.push_back(order_of(vesicle.position.rows()));
  const int order = *std::ranges::max_element(orders);
  return {{state.time, step, evaluation.diagnostics, order, evolution_.truncation(state), gap, std::move(orders)},
          state,
          evaluation.fields};
}

std::vector<RecordedSide> Simulation::sides() const {
  std::vector<RecordedSide> sides;
  for (const Evolution::DenseOutput& moment : evolution_.dense_output()) {
    sides.push_back(side_of(moment.state, moment.evaluation, moment.gap, attempt_of(moment.evaluation, true)));
  }
  const State& state = evolution_.state();
  const Evaluation& now = evolution_.evaluation();
  const std::optional<Evaluation>& before = evolution_.before_jump();
  if (!before) {
    sides.push_back(side_of(state, now, evolution_.gap(), last_));
    return sides;
  }
  StepAttempt arrival = last_;
  arrival.at_snapshot = false;
  sides.push_back(side_of(state, *before, evolution_.gap(), arrival));
  sides.push_back(side_of(state, now, evolution_.gap(), attempt_of(now, last_.at_snapshot)));
  return sides;
}

RunStatus Simulation::status() const {
  double drift = 0.0;
  for (const VesicleDiagnostics& vesicle : evolution_.evaluation().diagnostics.vesicles) {
    drift = std::max({drift, std::abs(vesicle.area_drift), std::abs(vesicle.volume_drift)});
  }
  const State& state = evolution_.state();
  const auto shown = [&](double time) { return time * time_unit_.factor; };
  return {state.step, shown(start_time_), shown(state.time), shown(scene_.numerics.end_time), shown(last_.dt), drift,
          seconds(),  time_unit_.symbol,  gap_text()};
}

/// Whether a scene that runs until rest may end now.
bool Simulation::at_rest() const {
  const NumericsScene& numerics = scene_.numerics;
  if (numerics.until != RunsUntil::rest) return false;
  constexpr double without_tolerance = 1e-3;
  const double time = evolution_.state().time;
  const double change = evolution_.largest_rate() * (numerics.end_time - time);
  if (!(change < numerics.tolerance.value_or(without_tolerance))) return false;
  for (const Scene& one : each_alone(scene_)) {
    for (const ActingWaveform& acting : acting_waveforms(one)) {
      if (acting.waveform.kind == WaveformKind::ac) return false;
      if (waveform_of(acting.waveform).next_discontinuity(time)) return false;
    }
  }
  return true;
}

/// The smallest gap in the unit of the history; empty for a single vesicle in unbounded fluid.
std::string Simulation::gap_text() const {
  const double gap = evolution_.gap().distance;
  if (!std::isfinite(gap)) return {};
  const OutputUnit unit = units_.of("length");
  return fmt::format("{:.3g}{}{}", gap * unit.factor, unit.is_si() ? " " : "", unit.symbol);
}

}  // namespace vehd
