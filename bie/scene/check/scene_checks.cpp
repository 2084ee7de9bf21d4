#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/read/reading_steps.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/shapes/placement.hpp"
#include "bie/scene/units.hpp"
#include "bie/scene/waveforms.hpp"
#include "bie/sphere/harmonics.hpp"

namespace vehd {
namespace {

/// Names of snapshots have six digits.
constexpr double most_snapshots = 999999;
constexpr double most_steps = 1e9;
/// Largest trace of a velocity gradient, relative to its entries: rounding of decimal input.
constexpr double trace_tolerance = 1e-12;
/// With steps of a whole period an alternating field would look constant.
constexpr double fewest_fixed_steps_a_period = 4.0;
/// Largest truncation error of a cap, relative to its step. The factor may fall below zero by as much.
constexpr double largest_truncation = 0.02;

/// Index of the first time that is before its predecessor; their number if they ascend.
std::size_t first_fall(const std::vector<double>& times) {
  return static_cast<std::size_t>(std::ranges::is_sorted_until(times) - times.begin());
}

class SceneChecks {
 public:
  SceneChecks(Scene& scene, const TomlFile& file, const std::vector<Scene>& all)
      : scene_(scene), file_(file), all_(all) {}

  void run() {
    check_steps();
    check_shape();
    if (scene_.flow && scene_.flow->kind == FlowKind::gradient) check_gradient();
    if (scene_.electric) check_electric(*scene_.electric);
    check_effects();
    if (scene_.flow) check_waveform("flow.waveform", scene_.flow->waveform);
    if (scene_.electric) check_waveform("electric.waveform", scene_.electric->waveform);
    if (scene_.membrane.pump) check_waveform("membrane.pump.waveform", scene_.membrane.pump->waveform);
    check_periods();
    check_output();
    check_varying_properties();
    check_shape_file();
    check_size();
    check_poration(scene_, file_);
  }

 private:
  /// @param key      "table.key"
  /// @param problem  {0} or the first {} is "key" in [table]
  template <typename... Arguments>
  void refuse_if(bool is_wrong, std::string_view key,
                 fmt::format_string<const std::string&, const Arguments&...> problem,
                 const Arguments&... arguments) const {
    if (!is_wrong) return;
    const std::size_t dot = key.rfind('.');
    const std::string called = fmt::format("\"{}\" in [{}]", key.substr(dot + 1), key.substr(0, dot));
    file_.refuse_key(key.substr(0, dot), key.substr(dot + 1), "{}", fmt::format(problem, called, arguments...));
  }

  void check_steps() const {
    const NumericsScene& n = scene_.numerics;
    refuse_if(!n.dt && !n.tolerance, "numerics.dt",
              "missing key \"dt\" in [numerics] (largest time step); accepted: > 0, or a \"tolerance\"");
    refuse_if(n.tolerance && n.time_order < 2, "numerics.time_order",
              "{} is 1, which has no error estimate; accepted with a tolerance: 2 to 5");
  }

  void check_shape() const {
    const ShapeScene& shape = scene_.shape;
    refuse_if(shape.area && shape.scale, "shape.scale", "{} together with \"area\"; accepted: one of them");
    refuse_if(scene_.units && has_unit_size(shape.kind) && !shape.area && !shape.scale, "shape.area",
              "missing key \"area\" in [shape]; its default of 4π depends on [units]; accepted: > 0, or a \"scale\"");
    const AxisAngle turn = shape.rotation.value_or(AxisAngle{1.0});
    refuse_if(turn[0] == 0.0 && turn[1] == 0.0 && turn[2] == 0.0, "shape.rotation",
              "{} has the axis 0, 0, 0; accepted: an axis that is not zero");
    if (shape.kind != ShapeKind::radial) return;
    // The default is accepted, because the effective scene spells it out.
    refuse_if(!shape.amplitude && shape.exponent != ShapeScene{}.exponent, "shape.exponent",
              "{} has no effect without \"amplitude\"");
    for (std::size_t i = 0; i < shape.modes.size(); ++i) {
      if (shape.modes[i].n <= scene_.numerics.order) continue;
      file_.refuse(*file_.table["shape"]["modes"][i].node(),
                   "\"modes\" in [shape] has the degree n = {}; accepted: at most the degree {} of [numerics]",
                   shape.modes[i].n, scene_.numerics.order);
    }
    const Extremes radius = radius_extremes(scene_);
    refuse_if(!(radius.least > 0.0), "shape.modes",
              "the radius in [shape] falls to {1}; accepted: > 0 and finite in every direction", radius.least);
    refuse_if(!size_range.contains(radius.least) || !size_range.contains(radius.most), "shape.modes",
              "the radius in [shape] is {1:.3g} to {2:.3g}; accepted: {3}", radius.least, radius.most,
              size_range.text());
  }

  void check_gradient() const {
    const auto& [x, y, z] = scene_.flow->gradient;
    const double trace = x[0] + y[1] + z[2];
    double largest = 0.0;
    for (const Triple& row : {x, y, z}) largest = std::max(largest, vector_of(row).cwiseAbs().maxCoeff());
    refuse_if(!(std::abs(trace) <= trace_tolerance * largest), "flow.gradient",
              "{} has the trace {}; accepted: 0 (incompressible flow)", trace);
  }

  void check_electric(const ElectricScene& electric) const {
    const bool steady = electric.initial_potential == InitialPotential::steady;
    const bool insulates = electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0;
    refuse_if(electric.conductivity_in == 0.0 && electric.conductivity_out == 0.0, "electric.conductivity_in",
              "\"conductivity_in\" and \"conductivity_out\" in [electric] are both 0; accepted: at least one > 0");
    refuse_if(electric.displacement_current && !file_.table["electric"]["permittivity"],
              "electric.displacement_current",
              "{} needs \"permittivity\" there, whose default is not that of any fluid");
    if (has_averaged_field(scene_)) {
      refuse_if(electric.initial_potential != InitialPotential::zero, "electric.initial_Vm",
                "{} has no effect with \"average\" in [electric.waveform]; accepted: zero");
      refuse_if(electric.waveform->phase != 0.0, "electric.waveform.phase",
                "{} has no effect with \"average\"; accepted: 0");
    }
    if (!has_relaxing_charge(scene_)) return;
    refuse_if(electric.initial_potential == InitialPotential::file, "electric.initial_Vm",
              "{} is file, but with \"displacement_current\" the charges of both faces count, which no file has; "
              "accepted: zero, steady");
    refuse_if(steady && insulates, "electric.initial_Vm",
              "{} is steady, but a conductivity is 0; accepted with \"displacement_current\": zero");
  }

  void check_effects() const {
    const MembraneScene& membrane = scene_.membrane;
    const auto is_heavy = [](const Scene& one) { return one.fluid.density_difference != 0.0; };
    refuse_if(scene_.gravity && std::ranges::none_of(all_, is_heavy), "gravity.acceleration",
              "[gravity] has no effect: \"density_difference\" in [fluid] is 0; accepted: any other value");
    refuse_if(is_heavy(scene_) && !scene_.gravity, "fluid.density_difference", "{} has no effect without [gravity]");
    refuse_if(scene_.gravity && scene_.gravity->acceleration == Triple{}, "gravity.acceleration",
              "{} is 0; accepted: a vector that is not zero");
    refuse_if(membrane.spontaneous_curvature != 0.0 && !(membrane.bending_modulus.value_or(0.0) > 0.0),
              "membrane.spontaneous_curvature", "{} has no effect without \"bending_modulus\"");
    check_undulations(scene_, file_, all_);
    refuse_if(!membrane.mobile && !scene_.electric, "membrane.mobile",
              "{} is false without [electric]: nothing would ever change");
  }

  void check_waveform(const std::string& table, const std::optional<WaveformScene>& waveform) const {
    if (!waveform) return;
    if (waveform->kind == WaveformKind::pulse_train) {
      refuse_if(waveform->period <= waveform->duration, table + ".period",
                "{} is {}; accepted: more than the duration {}", file_.typed(table + ".period"),
                file_.typed(table + ".duration"));
    }
    if (waveform->kind != WaveformKind::table) return;
    const auto& times = waveform->times;
    refuse_if(times.size() != waveform->values.size(), table + ".times",
              "the table of [{1}] has {2} times and {3} values; accepted: as many of either", table, times.size(),
              waveform->values.size());
    refuse_if(times.size() < 2, table + ".times", "the table of [{1}] has {2} entries; accepted: at least 2", table,
              times.size());
    // Times from a file of numbers are not in the scene.
    const auto text_of = [&](std::size_t i) {
      return file_.typed(fmt::format("{}.times[{}]", table, i), quantity_text(scene_.units, times[i], "time"));
    };
    const std::size_t fall = first_fall(times);
    if (fall < times.size()) {
      file_.refuse_key(table, "times", "the table of [{}] falls to the time {}; accepted: ascending times", table,
                       text_of(fall));
    }
    for (std::size_t i = 2; i < times.size(); ++i) {
      if (times[i] != times[i - 2]) continue;
      file_.refuse_key(table, "times",
                       "the table of [{}] has the time {} three times; accepted: twice, which makes a jump", table,
                       text_of(i));
    }
  }

  /// Fixed steps must resolve every period.
  void check_periods() const {
    if (!scene_.numerics.dt) return;
    for (const ActingWaveform& acting : acting_waveforms(scene_)) {
      if (!alternates(acting.waveform)) continue;
      const double steps = 1.0 / (acting.waveform.frequency * *scene_.numerics.dt);
      refuse_if(steps < fewest_fixed_steps_a_period, fmt::format("{}.frequency", acting.table),
                "\"dt\" in [numerics] takes {1:.3g} steps a period of [{2}]; accepted: at least {3:g}", steps,
                acting.table, fewest_fixed_steps_a_period);
    }
  }

  /// Refuses too many steps, naming the key that causes most of them.
  void require_few_steps() const {
    const NumericsScene& numerics = scene_.numerics;
    std::vector<std::pair<double, std::string>> demands;
    if (numerics.dt) demands.emplace_back(numerics.end_time / *numerics.dt, "numerics.dt");
    for (const ActingWaveform& acting : acting_waveforms(scene_)) {
      const bool repeats = acting.waveform.kind == WaveformKind::pulse_train;
      const char* key = alternates(acting.waveform) ? "frequency" : repeats ? "period" : "kind";
      demands.emplace_back(fewest_steps(acting.waveform, numerics.end_time), fmt::format("{}.{}", acting.table, key));
    }
    double steps = 0.0;
    for (const auto& [count, key] : demands) steps += count;
    if (steps <= most_steps) return;
    const auto& [count, key] = *std::ranges::max_element(demands);
    refuse_if(true, key, "{} makes {:.3g} steps; accepted: at most {:g}", count, most_steps);
  }

  void check_output() const {
    const OutputScene& output = scene_.output;
    const double end = scene_.numerics.end_time;
    for (std::size_t i = 0; i < output.windows.size(); ++i) {
      const OutputWindow& window = output.windows[i];
      const std::string path = fmt::format("output.window[{}]", i);
      refuse_if(!(window.every > 0.0 && window.to > window.from), "output.window",
                "{} goes from {} to {} every {}; accepted: a later \"to\" and an \"every\" > 0",
                file_.typed(path + ".from"), file_.typed(path + ".to"), file_.typed(path + ".every"));
    }
    require_few_steps();
    double count = 0.0;
    const auto add = [&](std::string_view key, double more) {
      count += more;
      refuse_if(count > most_snapshots, key, "{} makes {:.3g} snapshots; accepted: at most {:g}", count,
                most_snapshots);
    };
    if (output.every) add("output.every", end / *output.every);
    double in_windows = 0.0;
    for (const OutputWindow& window : output.windows) {
      in_windows += std::max(0.0, std::min(window.to, end) - window.from) / window.every;
    }
    add("output.window", in_windows);
    add("output.times", static_cast<double>(output.times.size()));
    const std::size_t fall = first_fall(output.times);
    if (fall < output.times.size()) {
      file_.refuse_key("output", "times", "\"times\" in [output] falls to {}; accepted: ascending times",
                       file_.typed(fmt::format("output.times[{}]", fall)));
    }
    refuse_if(output.units == ResultUnits::si && !scene_.units, "output.units",
              "{} is \"si\", but the scene has no table [units]");
  }

  enum class Sign { any, zero_or_more, above_zero };

  /// Spatially varying properties and the pump.
  void check_varying_properties() const {
    const MembraneScene& m = scene_.membrane;
    check_property("varying_capacitance", m.varying_capacitance, true, "capacitance", m.capacitance, Sign::above_zero);
    check_property("varying_conductance", m.varying_conductance, true, "conductance", m.conductance,
                   Sign::zero_or_more);
    check_property("varying_bending", m.varying_bending, false, "bending_modulus", m.bending_modulus.value_or(0.0),
                   Sign::above_zero);
    check_property("varying_curvature", m.varying_curvature, false, "spontaneous_curvature", m.spontaneous_curvature,
                   Sign::any);
    if (!m.pump) return;
    check_property("pump", *m.pump, true, "current", 1.0, Sign::any);
    check_pump(*m.pump);
  }

  /// @param value  of `key` in [membrane]: the property where the factor is 1
  /// @param sign   required sign of the property
  void check_property(std::string_view name, const std::optional<VaryingProperty>& varying, bool is_electric,
                      std::string_view key, double value, Sign sign) const {
    if (!varying) return;
    const std::string table = fmt::format("membrane.{}", name), kind = table + ".kind";
    refuse_if(is_electric && !scene_.electric, kind, "[{1}] has no effect without [electric]", table);
    refuse_if(!is_electric && !scene_.membrane.mobile, kind,
              "[{1}] has no effect while \"mobile\" in [membrane] is false", table);
    check_factor(table, *varying);
    refuse_if(value == 0.0, kind, "[{1}] has no effect: \"{2}\" in [membrane] is 0", table, key);
    if (sign == Sign::any) return;
    const int degree = scene_.numerics.order;
    const Vector factor = SphereTransform(degree, make_grid(2 * degree)).synthesize(varying_factor(*varying, degree));
    // A truncated cap may fall below zero.
    const double least = factor.minCoeff(), cut = -largest_truncation * factor.maxCoeff();
    refuse_if(!(sign == Sign::zero_or_more ? least >= cut : least > 0.0), kind,
              "the factor in [{1}] falls to {2:.3g}; accepted: {3} everywhere", table, least,
              sign == Sign::zero_or_more ? ">= 0" : "> 0");
  }

  void check_factor(const std::string& table, const VaryingProperty& varying) const {
    const int degree = scene_.numerics.order;
    for (const HarmonicMode& mode : varying.modes) {
      refuse_if(mode.n > degree, table + ".modes",
                "{} has the degree n = {}; accepted: at most the degree {} of [numerics]", mode.n, degree);
    }
    if (varying.kind != VariationKind::cap) return;
    refuse_if(varying.axis == Triple{}, table + ".axis", "{} is 0, 0, 0; accepted: a vector that is not zero");
    refuse_if(varying.angle_deg == 180.0, table + ".angle_deg", "{} is 180; accepted: less");
    const double truncation = varying_factor_truncation(varying, degree);
    refuse_if(truncation > largest_truncation, table + ".width_deg",
              "the edge of the cap in [{1}] is wrong by {2:.2g} of its step at the degree {3} of [numerics]; accepted: "
              "at most {4:g}, by a wider \"width_deg\" or a higher degree",
              table, truncation, degree, largest_truncation);
  }

  void check_pump(const PumpScene& pump) const {
    refuse_if(has_averaged_field(scene_), "membrane.pump.current",
              "\"average\" in [electric.waveform] is true with [membrane.pump], whose current has a time of its own; "
              "accepted: false");
    refuse_if(pump.current == 0.0, "membrane.pump.current", "{} is 0: it has no effect; accepted: any other");
    refuse_if(scene_.membrane.conductance == 0.0 && scene_.electric->initial_potential == InitialPotential::steady,
              "membrane.pump.current",
              "a pump and a steady \"initial_Vm\" in [electric] with \"conductance\" 0 in [membrane], where the pump "
              "never comes to rest; accepted: a conductance > 0, or zero");
  }

  void check_shape_file() {
    const ShapeScene& shape = scene_.shape;
    if (shape.kind != ShapeKind::file) {
      refuse_if(takes_stored_potential(scene_), "electric.initial_Vm",
                "{} is file, but the shape is not from a file; accepted: zero, steady");
      return;
    }
    std::error_code error;
    refuse_if(!std::filesystem::is_regular_file(shape.path, error), "shape.path", "{} is {}: no such file", shape.path);
    const RunReader run(shape.path);
    refuse_if(run.n_vesicles() > 1, "shape.path", "{} is {}, which holds {} vesicles; accepted: a run of one",
              shape.path, run.n_vesicles());
    const auto units = units_of(run);
    if (!shape.area) {
      require_scale(units, "length", &UnitsScene::length, "shape.path", "\"area\" in [shape], which sets the size");
    }
    if (shape.time) {
      require_scale(units, "time", &UnitsScene::time, "shape.time", "no \"time\", for the last snapshot");
      const double factor = *conversion(units, scene_.units, &UnitsScene::time);
      const double time = *shape.time / factor;
      refuse_if(!run.find(time), "shape.time", "{} is {}, at which {} has no snapshot; the nearest is at {}",
                file_.typed("shape.time"), shape.path,
                quantity_text(scene_.units, run.times()[run.nearest(time)] * factor, "time"));
    }
    refuse_if(!fix_snapshot(scene_, run), "shape.checksum", "{} is not that of {}, which has changed", shape.path);
    if (!scene_.electric || has_averaged_field(scene_) || has_relaxing_charge(scene_)) return;
    const bool has_potential = start_snapshot(run, scene_).has_field("Vm");
    if (has_potential && !file_.table["electric"]["initial_Vm"].is_string()) {
      scene_.electric->initial_potential = InitialPotential::file;
    }
    if (!takes_stored_potential(scene_)) return;
    refuse_if(!has_potential, "electric.initial_Vm", "{} is file, but {} has no V_m; accepted: zero, steady",
              shape.path);
    require_scale(units, "potential", &UnitsScene::potential, "electric.initial_Vm", "\"initial_Vm\" zero or steady");
  }

  /// @param way_out  alternative that does not need the scale
  void require_scale(const std::optional<UnitsScene>& of_run, std::string_view name,
                     std::optional<double> UnitsScene::*scale, std::string_view key, std::string_view way_out) const {
    if (conversion(of_run, scene_.units, scale)) return;
    const bool run_has_it = of_run && *of_run.*scale;
    const std::string this_scene = "this scene";
    refuse_if(true, key, "{} needs a reference {}, which {} has but {} lacks; accepted: {}, or {}", name,
              run_has_it ? scene_.shape.path : this_scene, run_has_it ? this_scene : scene_.shape.path,
              run_has_it ? fmt::format("\"{}\" in [units]", name) : "a run of a scene with [units]", way_out);
  }

  /// Area and volume must be positive and finite.
  void check_size() const {
    // About its own centre: the volume of a shape far from the origin would lose all its digits.
    Scene centred = scene_;
    centred.shape.centre = {};
    const ShapeSize size = size_of(initial_position(centred));
    const auto is_accepted = [](double value) { return value > 0.0 && std::isfinite(value); };
    if (is_accepted(size.area) && is_accepted(size.volume)) return;
    file_.refuse(*file_.table.get("shape"),
                 "the shape in [shape] has the area {:g} and the volume {:g}; accepted: > 0 and finite", size.area,
                 size.volume);
  }

  Scene& scene_;
  const TomlFile& file_;
  const std::vector<Scene>& all_;
};

}  // namespace

void check_scene(Scene& scene, const TomlFile& file, const std::vector<Scene>& all) {
  SceneChecks(scene, file, all).run();
}

}  // namespace vehd
