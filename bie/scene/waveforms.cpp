#include "bie/scene/waveforms.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vehd {

namespace {

bool is_zero(const FlowScene& flow) {
  if (flow.kind == FlowKind::gradient) return flow.gradient == TripleOfTriples{};
  return (flow.kind == FlowKind::poiseuille ? flow.centre_velocity : flow.rate) == 0.0;
}

}  // namespace

Waveform waveform_of(const WaveformScene& w) {
  if (w.kind == WaveformKind::ac) return Waveform::alternating(1.0, w.frequency, w.phase);
  if (w.kind == WaveformKind::burst) return Waveform::burst(1.0, w.frequency, w.phase, w.start, w.duration);
  if (w.kind == WaveformKind::pulse) return Waveform::pulse(1.0, w.start, w.duration);
  if (w.kind == WaveformKind::pulse_train) return Waveform::pulse_train(1.0, w.start, w.duration, w.period);
  return w.kind == WaveformKind::table ? Waveform::table(w.times, w.values) : Waveform();
}

std::vector<ActingWaveform> acting_waveforms(const Scene& scene) {
  std::vector<ActingWaveform> result;
  const auto add = [&](std::string_view table, const std::optional<WaveformScene>& waveform) {
    if (waveform) result.push_back({table, *waveform});
  };
  if (scene.flow && !is_zero(*scene.flow)) add("flow.waveform", scene.flow->waveform);
  if (scene.electric && scene.electric->field != Triple{}) {
    std::optional<WaveformScene> waveform = scene.electric->waveform;
    if (has_averaged_field(scene)) {
      if (waveform->kind == WaveformKind::ac) waveform.reset();
      if (waveform) waveform->kind = WaveformKind::pulse;
    }
    add("electric.waveform", waveform);
  }
  if (const auto& pump = scene.membrane.pump; pump && pump->current != 0.0) {
    add("membrane.pump.waveform", pump->waveform);
  }
  return result;
}

double fewest_steps(const WaveformScene& waveform, double end) {
  if (waveform.kind == WaveformKind::dc) return 0.0;
  if (waveform.kind == WaveformKind::ac) return fewest_steps_a_period * waveform.frequency * end;
  const auto after_zero = [end](const auto& n_until) { return n_until(end) - n_until(0.0); };
  if (waveform.kind == WaveformKind::table) {
    return after_zero([&](double time) {
      return static_cast<double>(std::ranges::upper_bound(waveform.times, time) - waveform.times.begin());
    });
  }
  const double in_bursts =
      waveform.kind != WaveformKind::burst
          ? 0.0
          : fewest_steps_a_period * waveform.frequency *
                std::clamp(std::min(waveform.start + waveform.duration, end) - std::max(waveform.start, 0.0), 0.0,
                           waveform.duration);
  // Starts of pulses, and their ends.
  const bool repeats = waveform.kind == WaveformKind::pulse_train;
  const auto since = [&](double first) {
    return after_zero([=, period = waveform.period](double time) {
      return repeats ? std::max(0.0, std::floor((time - first) / period) + 1.0) : double(first <= time);
    });
  };
  return in_bursts + since(waveform.start) + since(waveform.start + waveform.duration);
}

}  // namespace vehd
