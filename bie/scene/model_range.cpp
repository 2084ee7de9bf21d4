#include "bie/scene/model_range.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "bie/physics/effects/undulations.hpp"
#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/vesicles.hpp"

namespace vehd {
namespace {

/// Largest accepted ratio of a neglected effect to a modelled one.
constexpr double largest_share = 0.1;
/// In V; pores open near 1 V: Riske and Dimova 2005, DeBruin and Krassowska 1999.
constexpr double poration_potential = 1.0;
/// In N/m; membranes tear between 5 and 10 mN/m: Riske and Dimova 2005.
constexpr double lysis_tension = 5e-3;
/// In K; the viscosity of water falls by 2 % per kelvin.
constexpr double most_heating = 1.0;

/// Water near 298 K, in kg/m³ and J/(m³ K), and small ions in it, in m²/s.
constexpr double density = 1e3, heat_capacity = 4.18e6, diffusivity = 2e-9;
constexpr double room_temperature = 298.0;

double largest_factor(const std::optional<WaveformScene>& waveform) {
  if (!waveform || waveform->kind != WaveformKind::table) return 1.0;
  double most = 0.0;
  for (const double value : waveform->values) most = std::max(most, std::abs(value));
  return most;
}

/// Shortest time in which the field changes: 1/ω, the duration of a pulse or of the pause after it, the shortest
/// interval of a table.
double shortest_time(const WaveformScene& waveform) {
  if (alternates(waveform)) return 1.0 / (2.0 * std::numbers::pi * waveform.frequency);
  if (waveform.kind == WaveformKind::pulse) return waveform.duration;
  if (waveform.kind == WaveformKind::pulse_train) {
    return std::min(waveform.duration, waveform.period - waveform.duration);
  }
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < waveform.times.size(); ++i) {
    const double interval = waveform.times[i] - waveform.times[i - 1];
    if (interval > 0.0) shortest = std::min(shortest, interval);
  }
  return shortest;
}

/// ∫ factor² dt between two times.
double exposure(const std::optional<WaveformScene>& waveform, double from, double to) {
  const auto within = [&](double first, double last) {
    return std::max(0.0, std::min(last, to) - std::max(first, from));
  };
  if (!waveform) return to - from;
  const double start = waveform->start, duration = waveform->duration;
  switch (waveform->kind) {
    case WaveformKind::dc:
      return to - from;
    case WaveformKind::ac:
      return 0.5 * (to - from);
    case WaveformKind::burst:
      return 0.5 * within(start, start + duration);
    case WaveformKind::pulse:
      return within(start, start + duration);
    case WaveformKind::pulse_train: {
      const auto in_pulses_until = [&](double time) {
        const double since = std::max(0.0, time - start), n_pulses = std::floor(since / waveform->period);
        return n_pulses * duration + std::min(duration, since - n_pulses * waveform->period);
      };
      return in_pulses_until(to) - in_pulses_until(from);
    }
    case WaveformKind::table:
      break;
  }
  const std::vector<double>&times = waveform->times, &values = waveform->values;
  double sum = within(from, times.front()) * values.front() * values.front() +
               within(times.back(), to) * values.back() * values.back();
  for (std::size_t i = 1; i < times.size(); ++i) {
    const double a = values[i - 1], b = values[i];
    sum += within(times[i - 1], times[i]) * (a * a + a * b + b * b) / 3.0;
  }
  return sum;
}

/// Compares one vesicle with the limits of the model.
class ModelRangeChecks {
 public:
  explicit ModelRangeChecks(const Scene& scene) : scene_(scene), groups_(dimensionless_groups(scene)) {
    if (!scene.electric) return;
    unit_field_ = vector_of(scene.electric->field).norm();
    field_ = unit_field_ * largest_factor(scene.electric->waveform);
  }

  /// Estimates for a sphere: V_m = 3/2 E a once charged, and a tension that balances the stress of field and flow.
  [[nodiscard]] ReachedValues expected() const {
    ReachedValues result;
    result.end_time = scene_.numerics.end_time;
    result.mean_tension = scene_.fluid.viscosity * shear_rate() * radius();
    if (field_ > 0.0) {
      const ElectricScene& electric = *scene_.electric;
      result.mean_tension += electric.permittivity * field_ * field_ * radius();
      const double series = 2.0 * electric.conductivity_in * electric.conductivity_out /
                            (electric.conductivity_in + 2.0 * electric.conductivity_out);
      const double leak = scene_.membrane.conductance * radius();
      result.potential = 1.5 * field_ * radius() * charged_share();
      if (series > 0.0) result.potential *= series / (series + leak);
    }
    result.tension = result.mean_tension;
    if (const auto law = area_law()) result.least_mean_tension = law->tension(area());
    return result;
  }

  std::vector<ModelWarning> warnings_at(const ReachedValues& reached) {
    if (!scene_.poration) judge_potential(reached.potential);
    if (scene_.membrane.mobile) judge_mechanics(reached);
    if (field_ > 0.0) judge_electrolyte(reached);
    return std::move(warnings_);
  }

 private:
  void warn_if(bool is_beyond, std::string_view name, double value, double limit, std::string text) {
    if (is_beyond) warnings_.push_back({std::string(name), value, limit, std::move(text)});
  }

  void judge_potential(double potential) {
    const double volts = si(potential, "potential");
    warn_if(volts > poration_potential, "poration", volts, poration_potential,
            fmt::format("V_m reaches {}; membranes porate near 1 V, and the scene has no [poration]",
                        si_number(volts, "potential")));
  }

  void judge_mechanics(const ReachedValues& reached) {
    const MembraneScene& membrane = scene_.membrane;
    const double tension = si(reached.tension, "force/length");
    const bool is_watched = scene_.poration && scene_.poration->lysis_tension;
    warn_if(tension > lysis_tension && !is_watched, "lysis", tension, lysis_tension,
            fmt::format("the tension reaches {}; membranes tear at 5 to 10 mN/m", si_number(tension, "force/length")));
    judge_buckling(reached.least_mean_tension);
    const bool acts = field_ > 0.0 || shear_rate() > 0.0 || scene_.gravity;
    if (membrane.inextensible && !membrane.undulations && acts) judge_constant_area(reached.mean_tension);
    judge_inertia();
  }

  void judge_buckling(double mean_tension) {
    const auto law = area_law();
    if (!law) return;
    constexpr double close_to_least = 0.99;
    const double share = mean_tension / law->least_tension();
    warn_if(share > close_to_least, "buckling", share, close_to_least,
            fmt::format("the mean tension falls to {}, where the membrane buckles: its area at rest exceeds its area "
                        "by more than thermal undulations store",
                        quantity_text(scene_.units, mean_tension, "force/length")));
  }

  /// Warns if this tension would pull area out of thermal undulations, and about spheres.
  void judge_constant_area(double mean_tension) {
    const double excess = group("Δ");
    if (is_sphere(initial_position(scene_))) {
      warn_if(true, "exact_sphere", excess, 0.0,
              "an exact sphere of constant area keeps its shape, and its uniform tension is not determined; "
              "\"undulations\" in [membrane] determine it");
      return;
    }
    const double rigidity = 0.5 * si(scene_.membrane.bending_modulus.value_or(0.0), "energy");
    const double tension = si(mean_tension, "force/length");
    if (!(rigidity > 0.0 && tension > 0.0)) return;
    const double temperature = scene_.units->temperature.value_or(room_temperature);
    const double area = 4.0 * std::numbers::pi * std::pow(si(radius(), "length"), 2);
    const double strain = AreaLaw({boltzmann_constant * temperature, rigidity, {}, area}).area(tension) / area - 1.0;
    const double shown = strain * (4.0 * std::numbers::pi + excess);
    warn_if(shown > largest_share * excess, "undulations", shown, largest_share * excess,
            fmt::format("a mean tension of {} pulls {:.2g} of the area out of thermal undulations, which are off; the "
                        "shape has {:.2g} to spare",
                        si_number(tension, "force/length"), strain, excess / (4.0 * std::numbers::pi + excess)));
  }

  void judge_inertia() {
    const double viscosity = si(scene_.fluid.viscosity, "viscosity");
    const double stress =
        field_ > 0.0 ? si(scene_.electric->permittivity, "permittivity") * std::pow(si(field_, "field"), 2) : 0.0;
    // The field strains a sphere at up to this rate.
    const double by_field = 9.0 * stress / ((32.0 + 23.0 * scene_.fluid.viscosity_ratio) * viscosity);
    const double rate = by_field + (shear_rate() > 0.0 ? si(shear_rate(), "1/time") : 0.0);
    const double reynolds = density * rate * std::pow(si(radius(), "length"), 2) / viscosity;
    warn_if(reynolds > largest_share, "inertia", reynolds, largest_share,
            fmt::format("the Reynolds number ρa²/μ times the rate of deformation is {:.2g}; the model has no inertia",
                        reynolds));
  }

  void judge_electrolyte(const ReachedValues& reached) {
    const ElectricScene& electric = *scene_.electric;
    if (!electric.displacement_current) {
      double fastest = group("t_m");
      if (electric.waveform) fastest = std::fmin(fastest, shortest_time(*electric.waveform));
      const double ratio = group("t_MW") / fastest;
      warn_if(ratio > largest_share, "charge_relaxation", ratio, largest_share,
              fmt::format("the charge of the fluids relaxes in {:.2g} of the time in which field and V_m change; "
                          "\"displacement_current\" in [electric] is off",
                          ratio));
    }
    // Debye layers λ_D = √(εD/σ) on both sides: capacitances ε/λ_D in series with that of the membrane.
    double longest = 0.0, layers = 0.0;
    for (const auto& [conductivity, ratio] : {std::pair{electric.conductivity_in, electric.permittivity_ratio},
                                              std::pair{electric.conductivity_out, 1.0}}) {
      if (conductivity == 0.0) continue;
      const double permittivity = ratio * si(electric.permittivity, "permittivity");
      const double length = std::sqrt(permittivity * diffusivity / si(conductivity, "conductivity"));
      longest = std::max(longest, length);
      layers += length / permittivity;
    }
    const double share = layers * si(scene_.membrane.capacitance, "capacitance/area");
    warn_if(share > largest_share, "debye_length", share, largest_share,
            fmt::format("the Debye length is {}: the charge of the fluids is in series with the membrane and lowers "
                        "C_m by {:.0f} %",
                        si_number(longest, "length"), 100.0 * share / (1.0 + share)));
    const double power = std::max(electric.conductivity_in, electric.conductivity_out) * unit_field_ * unit_field_ *
                         exposure(electric.waveform, reached.start_time, reached.end_time);
    const double heating = si(power, "force/area") / heat_capacity;
    warn_if(heating > most_heating, "heating", heating, most_heating,
            fmt::format("without cooling the current heats the fluid by {:.2g} K", heating));
  }

  /// Fraction of its fully charged value that V_m reaches.
  [[nodiscard]] double charged_share() const {
    const ElectricScene& electric = *scene_.electric;
    const double charging = group("t_m"), end = scene_.numerics.end_time;
    if (electric.waveform && alternates(*electric.waveform)) {
      return 1.0 / std::hypot(1.0, 2.0 * std::numbers::pi * electric.waveform->frequency * charging);
    }
    if (electric.initial_potential == InitialPotential::steady) return 1.0;
    if (std::isnan(charging)) return 0.0;
    const auto share_after = [charging](double time) { return -std::expm1(-time / charging); };
    if (!electric.waveform) return share_after(end);
    const double in_pulse = std::min(electric.waveform->duration, end);
    switch (electric.waveform->kind) {
      case WaveformKind::pulse:
        return share_after(in_pulse);
      case WaveformKind::pulse_train:
        // At the end of a pulse after many of them.
        return share_after(in_pulse) / share_after(electric.waveform->period);
      default:
        return share_after(end);
    }
  }

  /// Value of the group with this symbol; NaN if the scene has none.
  [[nodiscard]] double group(std::string_view symbol) const {
    const auto found = std::ranges::find(groups_, symbol, &DimensionlessGroup::symbol);
    return found == groups_.end() ? std::numeric_limits<double>::quiet_NaN() : found->value;
  }
  [[nodiscard]] double radius() const { return group("a"); }
  [[nodiscard]] double area() const { return 4.0 * std::numbers::pi * radius() * radius(); }
  /// Law of the area with undulations.
  [[nodiscard]] std::optional<AreaLaw> area_law() const {
    const auto undulations = model_of(scene_).vesicles.front().undulations;
    return undulations ? std::optional(AreaLaw(with_rest_area(*undulations, area()))) : std::nullopt;
  }
  /// Largest rate of the flow.
  [[nodiscard]] double shear_rate() const {
    return scene_.flow ? std::fmax(0.0, 1.0 / group("t_γ")) * largest_factor(scene_.flow->waveform) : 0.0;
  }
  /// Value in SI units; NaN without a scale, which exceeds no limit.
  [[nodiscard]] double si(double value, std::string_view dimension) const {
    return value * si_scale(scene_.units, dimension);
  }

  const Scene& scene_;
  std::vector<DimensionlessGroup> groups_;
  double unit_field_ = 0.0;  ///< magnitude where the waveform is 1
  double field_ = 0.0;       ///< largest magnitude
  std::vector<ModelWarning> warnings_;
};

}  // namespace

std::vector<ModelWarning> model_warnings(const Scene& scene, const std::vector<ReachedValues>& reached) {
  std::vector<ModelWarning> all;
  const std::vector<Scene> each = each_alone(scene);
  for (std::size_t a = 0; a < each.size(); ++a) {
    ModelRangeChecks checks(each[a]);
    for (ModelWarning& warning : checks.warnings_at(reached.empty() ? checks.expected() : reached.at(a))) {
      const auto known = std::ranges::find(all, warning.name, &ModelWarning::name);
      if (known == all.end()) {
        all.push_back(std::move(warning));
      } else if (warning.value * known->limit > known->value * warning.limit) {
        *known = std::move(warning);
      }
    }
  }
  return all;
}

}  // namespace vehd
