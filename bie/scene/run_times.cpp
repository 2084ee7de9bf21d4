#include "bie/scene/run_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "bie/scene/output_units.hpp"
#include "bie/scene/units.hpp"

namespace vehd {
namespace {

/// The model has the charge of the fluids follow at once.
/// @param other  shortest time of charging and forcing
std::string relaxation_text(const Scene& scene, double time, double other) {
  constexpr double short_against = 0.1;
  if (scene.electric->displacement_current) return "; by displacement currents";
  if (time <= short_against * other) return "; short, as the model needs";
  return "; not short against charging and waveform: displacement currents would matter";
}

}  // namespace

std::string RunTime::text() const { return seconds ? si_number(*seconds, "time") : fmt::format("{:.4g}", value); }

std::vector<RunTime> run_times(const Scene& scene, const std::vector<DimensionlessGroup>& groups) {
  const double end = scene.numerics.end_time;
  std::vector<RunTime> times;
  const auto add = [&](std::string name, std::string symbol, double value, std::string meaning) {
    const double seconds = value * si_scale(scene.units, "time");
    times.push_back({std::move(name), std::move(symbol), value,
                     std::isfinite(seconds) ? std::optional(seconds) : std::nullopt, std::move(meaning)});
  };
  double shortest = std::numeric_limits<double>::infinity();
  for (const DimensionlessGroup& group : groups) {
    if (group.unit != "time") continue;
    if (group.symbol == "t_m") shortest = group.value;
    std::string meaning(group.meaning);
    if (end > 0.0) meaning += fmt::format("; the run lasts {:.3g} {}", end / group.value, group.symbol);
    add(std::string(group.name), std::string(group.symbol), group.value, std::move(meaning));
  }
  const auto add_waveform = [&](const std::string& of, const std::optional<WaveformScene>& waveform) {
    if (!waveform) return;
    const auto count = [end](double time) { return fmt::format("{:.3g}", end / time); };
    const double period = waveform->kind == WaveformKind::ac ? 1.0 / waveform->frequency : waveform->period;
    if (waveform->kind == WaveformKind::ac) {
      add(of + " period", "1/f", period,
          (waveform->average ? "averaged; the run has " : "at least four steps each; the run has ") + count(period));
      // It changes within 1/ω.
      shortest = std::min(shortest, period / (2.0 * std::numbers::pi));
    }
    if (waveform->kind == WaveformKind::pulse_train) {
      add(of + " period", "", period, "from pulse to pulse; the run has " + count(period));
    }
    if (waveform->kind == WaveformKind::pulse_train || waveform->kind == WaveformKind::pulse) {
      add(of + " pulse", "", waveform->duration,
          fmt::format("a step ends where it begins and ends; the run lasts {} of it", count(waveform->duration)));
      shortest = std::min(shortest, waveform->duration);
    }
  };
  if (scene.electric) add_waveform("field", scene.electric->waveform);
  if (scene.flow) add_waveform("flow", scene.flow->waveform);
  if (end > 0.0) add("run", "t_end", end, "from start to end");
  std::ranges::stable_sort(times, {}, &RunTime::value);
  for (RunTime& time : times) {
    if (time.symbol == "t_MW") time.meaning += relaxation_text(scene, time.value, shortest);
  }
  return times;
}

}  // namespace vehd
