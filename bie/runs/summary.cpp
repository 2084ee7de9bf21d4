#include "bie/runs/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bie/files/versions.hpp"
#include "bie/runs/verdict.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

constexpr std::array largest_of = {"area_drift", "volume_drift", "strain_max", "spectrum_tail", "quadrature_error"};

/// Changes with times in the unit of the history.
nlohmann::json changes_in(const OutputUnit& time, std::vector<SceneChange> changes) {
  for (SceneChange& change : changes) change.time *= time.factor;
  return json_of(changes);
}

/// When and where the criterion was first met; null if it was not, as JSON has no infinity.
nlohmann::json poration_of(const HistoryTable& history) {
  const auto& times = history.column("poration_time");
  const double most = history.largest_magnitude("poration_load");
  nlohmann::json json{{"load_max", most}, {"time", nullptr}, {"place", nullptr}};
  if (times.empty() || !std::isfinite(times.back())) {
    json["text"] = fmt::format("not met, {:.3g} of the threshold at most", most);
    return json;
  }
  const double x = history.column("poration_x").back(), y = history.column("poration_y").back(),
               z = history.column("poration_z").back();
  const std::string& unit = history.unit("poration_x");
  // The load is flat at its maximum, so the position is accurate to the square root of rounding only.
  const double least = 1e-6 * std::max({std::abs(x), std::abs(y), std::abs(z)});
  const auto shown = [&](double value) { return std::abs(value) < least ? 0.0 : value; };
  json["time"] = times.back();
  json["place"] = {x, y, z};
  json["text"] = fmt::format("first met at time {} at ({:.4g}, {:.4g}, {:.4g}){}{}", history.time_text(times.back()),
                             shown(x), shown(y), shown(z), unit.empty() ? "" : " ", unit);
  return json;
}

double last(const std::vector<double>& values) { return values.empty() ? 0.0 : values.back(); }

/// Values of each vesicle in units of the scene, whatever the units of the table.
/// @param rows  of each vesicle
std::vector<ReachedValues> reached_values(const HistoryTable& rows, const Scene& scene) {
  const OutputUnits units = rows.units(scene.units);
  const auto column = [&](const char* name, const char* dimension) {
    std::vector<double> values = rows.column(name);
    for (double& value : values) value /= units.of(dimension).factor;
    return values;
  };
  const auto time = column("time", "time"), potential = column("Vm_max", "potential"), area = column("area", "area"),
             tension = column("tension_max", "force/length"), integral = column("tension_integral", "energy");
  std::vector<ReachedValues> reached(std::max<std::size_t>(1, scene.vesicles.size()));
  for (std::size_t row = 0; row < rows.n_rows(); ++row) {
    ReachedValues& of = reached.at(rows.has("vesicle") ? static_cast<std::size_t>(rows.column("vesicle")[row]) : 0);
    of.potential = std::max(of.potential, potential[row]);
    of.tension = std::max(of.tension, tension[row]);
    of.mean_tension = std::max(of.mean_tension, integral[row] / area[row]);
    of.least_mean_tension = std::min(of.least_mean_tension, integral[row] / area[row]);
    of.start_time = time.front();
    of.end_time = time[row];
  }
  return reached;
}

}  // namespace

nlohmann::json summary_of(const HistoryTable& history, const HistoryTable& of_each, const Scene& scene,
                          const Checkpoint& checkpoint, const RunOutcome& outcome) {
  const RunTotals& totals = checkpoint.totals;
  const auto& rejected = history.column("rejected");
  const std::int64_t steps = history.n_steps();
  nlohmann::json json;
  json["completed"] = outcome.completed;
  json["verdict"] = verdict_of(history, trust_demands(scene), outcome.reason);
  if (!outcome.completed) json["reason"] = outcome.reason;
  json["warnings"] = json_of(model_warnings(scene, reached_values(of_each, scene)));
  json["changes"] = changes_in(history.units(scene.units).of("time"), checkpoint.changes);
  if (checkpoint.origin) {
    const State& state = checkpoint.origin->state;
    const double time = state.time * history.units(scene.units).of("time").factor;
    json["from"] = {{"run", checkpoint.origin->run}, {"time", time}, {"step", state.step}};
  }
  json["time"] = last(history.column("time"));
  json["units"] = {{"time", history.unit("time").empty() ? "1" : history.unit("time")}};
  json["steps"] = steps;
  json["rejected_steps"] = static_cast<std::int64_t>(std::accumulate(rejected.begin(), rejected.end(), 0.0));
  json["seconds"] = totals.seconds;
  json["seconds_per_step"] = steps == 0 ? 0.0 : totals.seconds / static_cast<double>(steps);
  json["seconds_of_parts"] = totals.seconds_of_parts;
  json["peak_memory_bytes"] = peak_memory_bytes();
  for (const char* column : largest_of) json[column] = history.largest_magnitude(column);
  json["order_max"] = history.largest_magnitude("order");
  json["truncation"] = history.largest_magnitude("truncation");
  const auto& separation = history.column("separation");
  // JSON has no infinity: absent if no two parts of the membrane face each other.
  if (const auto least = std::min_element(separation.begin(), separation.end());
      least != separation.end() && std::isfinite(*least)) {
    json["separation"] = *least;
  }
  if (history.has("smallest_gap")) json["vesicles"] = vesicle_names(scene);
  for (const char* name : {"smallest_gap", "gap_wall"}) {
    if (!history.has(name) || history.column(name).empty()) continue;
    json[name] = std::ranges::min(history.column(name));
  }
  if (const std::string regime = regime_of(history, history.units(scene.units)); !regime.empty()) {
    json["regime"] = regime;
  }
  if (history.has("poration_time")) json["poration"] = poration_of(history);
  json["bending_energy_scaled"] = last(history.column("bending_energy_scaled"));
  json["kernel_evaluations"] = totals.kernel_evaluations;
  if (!totals.pair_targets.empty()) json["pair_targets"] = totals.pair_targets;
  json["version"] = program_version();
  return json;
}

std::string regime_of(const HistoryTable& history, const OutputUnits& units) {
  if (!history.has("tumbling_angle_deg") || history.n_rows() < 2) return "";
  if (history.largest_magnitude("tumbling_frequency") == 0.0 &&
      history.largest_magnitude("treading_frequency") == 0.0) {
    return "";
  }
  const auto& times = history.column("time");
  const auto& angle = history.column("tumbling_angle_deg");
  const auto& treading = history.column("treading_frequency");
  const double middle = 0.5 * (times.front() + times.back());
  const double revolution = units.of("time").factor * units.of("1/time").factor;
  double turned = 0.0, least = 0.0, most = 0.0, last_turn = 0.0, trodden = 0.0;
  int n_reversals = 0;
  for (std::size_t i = 1; i < times.size(); ++i) {
    if (times[i - 1] < middle) continue;
    trodden += 0.5 * (times[i] - times[i - 1]) * (treading[i] + treading[i - 1]) / revolution;
    const double turn = std::remainder(angle[i] - angle[i - 1], 180.0);
    turned += turn;
    least = std::min(least, turned);
    most = std::max(most, turned);
    if (turn == 0.0) continue;
    if (turn * last_turn < 0.0) ++n_reversals;
    last_turn = turn;
  }
  if (std::abs(turned) >= 180.0) return "tumbling";
  if (most - least <= 1.0) return std::abs(trodden) >= 0.25 ? "tank-treading" : "unsettled";
  return n_reversals >= 2 ? "trembling" : "unsettled";
}

nlohmann::json json_of(const std::vector<ModelWarning>& warnings) {
  nlohmann::json json = nlohmann::json::array();
  for (const ModelWarning& warning : warnings) {
    json.push_back(
        {{"name", warning.name}, {"value", warning.value}, {"limit", warning.limit}, {"text", warning.text}});
  }
  return json;
}

}  // namespace vehd
