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

class Times {
 public:
  Times(const Scene& scene, const std::vector<DimensionlessGroup>& groups)
      : scene_(scene), seconds_(si_scale(scene.units, "time")) {
    for (const DimensionlessGroup& group : groups) {
      if (group.unit == "time") add(std::string(group.name), std::string(group.symbol), group.value, meaning_of(group));
    }
    if (scene.electric && scene.electric->waveform) add_waveform("field", *scene.electric->waveform);
    if (scene.flow && scene.flow->waveform) add_waveform("flow", *scene.flow->waveform);
    if (scene.numerics.end_time > 0.0) add("run", "t_end", scene.numerics.end_time, "from start to end");
    std::ranges::stable_sort(times_, {}, &RunTime::value);
    for (RunTime& time : times_) {
      if (time.symbol == "t_MW") time.meaning += relaxation_text(time.value);
    }
  }

  std::vector<RunTime> take() { return std::move(times_); }

 private:
  void add(std::string name, std::string symbol, double value, std::string meaning) {
    std::optional<double> seconds;
    if (std::isfinite(seconds_)) seconds = value * seconds_;
    times_.push_back({std::move(name), std::move(symbol), value, seconds, std::move(meaning)});
  }

  [[nodiscard]] std::string meaning_of(const DimensionlessGroup& group) const {
    const double end = scene_.numerics.end_time;
    std::string text(group.meaning);
    if (end > 0.0) text += fmt::format("; the run lasts {:.3g} {}", end / group.value, group.symbol);
    return text;
  }

  void add_waveform(const std::string& of, const WaveformScene& waveform) {
    switch (waveform.kind) {
      case WaveformKind::dc:
      case WaveformKind::table:
        return;
      case WaveformKind::ac:
        forcing(of + " period", "1/f", 1.0 / waveform.frequency, 2.0 * std::numbers::pi,
                waveform.average ? "averaged; the run has {:.3g}" : "at least four steps each; the run has {:.3g}");
        return;
      case WaveformKind::pulse_train:
        add(of + " period", "", waveform.period,
            count_text(waveform.period, "from pulse to pulse; the run has {:.3g}"));
        [[fallthrough]];
      case WaveformKind::pulse:
        forcing(of + " pulse", "", waveform.duration, 1.0,
                "a step ends where it begins and ends; the run lasts {:.3g} of it");
    }
  }

  /// @param share  of it in which the forcing changes: 1/ω of a period
  void forcing(const std::string& name, const std::string& symbol, double time, double share, const char* meaning) {
    add(name, symbol, time, count_text(time, meaning));
    shortest_forcing_ = std::min(shortest_forcing_, time / share);
  }

  [[nodiscard]] std::string count_text(double time, const char* text) const {
    return fmt::format(fmt::runtime(text), scene_.numerics.end_time / time);
  }

  /// The model has the charge of the fluids follow at once.
  [[nodiscard]] std::string relaxation_text(double time) const {
    constexpr double short_against = 0.1;
    double other = shortest_forcing_;
    for (const RunTime& each : times_) {
      if (each.symbol == "t_m") other = std::min(other, each.value);
    }
    if (scene_.electric->displacement_current) return "; by displacement currents";
    if (time <= short_against * other) return "; short, as the model needs";
    return "; not short against charging and waveform: displacement currents would matter";
  }

  const Scene& scene_;
  double seconds_;
  double shortest_forcing_ = std::numeric_limits<double>::infinity();
  std::vector<RunTime> times_;
};

}  // namespace

std::string RunTime::text() const { return seconds ? si_number(*seconds, "time") : fmt::format("{:.4g}", value); }

std::vector<RunTime> run_times(const Scene& scene, const std::vector<DimensionlessGroup>& groups) {
  return Times(scene, groups).take();
}

}  // namespace vehd
