#include "bie/scene/run_times.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/scene/output_units.hpp"
#include "bie/scene/units.hpp"

namespace vehd {

std::string RunTime::text() const { return seconds ? si_number(*seconds, "time") : fmt::format("{:.4g}", value); }

std::vector<RunTime> run_times(const Scene& scene, const std::vector<DimensionlessGroup>& groups) {
  const double end = scene.numerics.end_time;
  std::vector<RunTime> times;
  const auto add = [&](std::string name, std::string symbol, double value, std::string meaning) {
    const double seconds = value * si_scale(scene.units, "time");
    times.push_back({std::move(name), std::move(symbol), value,
                     std::isfinite(seconds) ? std::optional(seconds) : std::nullopt, std::move(meaning)});
  };
  for (const DimensionlessGroup& group : groups) {
    if (group.unit != "time") continue;
    std::string meaning(group.meaning);
    if (end > 0.0) meaning += fmt::format("; the run lasts {:.3g} {}", end / group.value, group.symbol);
    add(std::string(group.name), std::string(group.symbol), group.value, std::move(meaning));
  }
  const auto add_waveform = [&](const std::string& of, const std::optional<WaveformScene>& waveform) {
    if (!waveform) return;
    const auto count = [end](double time) { return fmt::format("{:.3g}", end / time); };
    const double period = alternates(*waveform) ? 1.0 / waveform->frequency : waveform->period;
    if (alternates(*waveform)) {
      add(of + " period", "1/f", period,
          (waveform->average ? "averaged; the run has " : "at least four steps each; the run has ") + count(period));
    }
    if (waveform->kind == WaveformKind::pulse_train) {
      add(of + " period", "", period, "from pulse to pulse; the run has " + count(period));
    }
    if (waveform->kind == WaveformKind::pulse_train || waveform->kind == WaveformKind::pulse ||
        waveform->kind == WaveformKind::burst) {
      add(of + (waveform->kind == WaveformKind::burst ? " burst" : " pulse"), "", waveform->duration,
          fmt::format("a step ends where it begins and ends; the run lasts {} of it", count(waveform->duration)));
    }
  };
  if (scene.electric) add_waveform("field", scene.electric->waveform);
  if (scene.flow) add_waveform("flow", scene.flow->waveform);
  if (scene.membrane.pump) add_waveform("pump", scene.membrane.pump->waveform);
  if (end > 0.0) add("run", "t_end", end, "from start to end");
  std::ranges::stable_sort(times, {}, &RunTime::value);
  return times;
}

}  // namespace vehd
