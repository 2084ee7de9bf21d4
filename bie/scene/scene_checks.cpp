#include "bie/scene/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "bie/scene/initial_shape.hpp"
#include "bie/scene/placement.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/schema.hpp"
#include "bie/scene/toml_values.hpp"
#include "bie/scene/waveforms.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// Names of snapshots have six digits.
constexpr double most_snapshots = 999999;
constexpr double most_steps = 1e9;
/// Largest trace of a velocity gradient, relative to its entries: what decimal input rounds to.
constexpr double trace_tolerance = 1e-12;
/// A step as long as the period would see an alternating field as constant.
constexpr double fewest_fixed_steps_a_period = 4.0;

class Checks {
 public:
  Checks(const Scene& scene, const toml::table& table, const std::string& file, bool is_heavy)
      : scene_(scene), table_(table), file_(file), is_heavy_(is_heavy) {}

  void run() const {
    check_steps();
    check_placement();
    if (scene_.shape.kind == ShapeKind::radial) check_radial_shape();
    if (scene_.flow && scene_.flow->kind == FlowKind::gradient) check_gradient();
    if (scene_.electric) check_conductivities();
    if (scene_.electric) check_displacement_current();
    if (scene_.electric && has_averaged_field(scene_)) check_average();
    if (scene_.electric && has_relaxing_charge(scene_)) check_relaxing_charge();
    check_effects();
    if (scene_.flow && scene_.flow->waveform) check_waveform("flow.waveform", *scene_.flow->waveform);
    if (scene_.electric && scene_.electric->waveform) {
      check_waveform("electric.waveform", *scene_.electric->waveform);
    }
    if (const auto& pump = scene_.membrane.pump; pump && pump->waveform) {
      check_waveform("membrane.pump.waveform", *pump->waveform);
    }
    check_periods();
    check_windows();
    check_counts();
    check_output();
  }

 private:
  [[noreturn]] void refuse(std::string_view table, std::string_view key, const std::string& problem) const {
    refuse_key(table_, table, key, file_, problem);
  }

  void check_effects() const {
    const bool heavy = scene_.fluid.density_difference != 0.0;
    if (scene_.gravity && !heavy && !is_heavy_) {
      refuse("gravity", "acceleration",
             "[gravity] acts on nothing: \"density_difference\" in [fluid] is 0; accepted: any other value");
    }
    if (heavy && !scene_.gravity) {
      refuse("fluid", "density_difference", "\"density_difference\" in [fluid] has no effect without [gravity]");
    }
    if (scene_.gravity && scene_.gravity->acceleration == Triple{}) {
      refuse("gravity", "acceleration", "\"acceleration\" in [gravity] is 0; accepted: a vector that is not zero");
    }
    if (scene_.membrane.spontaneous_curvature != 0.0 && !(scene_.membrane.bending_modulus.value_or(0.0) > 0.0)) {
      refuse("membrane", "spontaneous_curvature",
             "\"spontaneous_curvature\" in [membrane] has no effect without \"bending_modulus\"");
    }
    if (!scene_.membrane.mobile && !scene_.electric) {
      refuse("membrane", "mobile", "\"mobile\" in [membrane] is false without [electric]: nothing would ever change");
    }
  }

  void check_displacement_current() const {
    if (!scene_.electric->displacement_current) return;
    if (!table_["electric"]["permittivity"]) {
      refuse("electric", "displacement_current",
             "\"displacement_current\" in [electric] needs \"permittivity\" there, whose default is not that of any "
             "fluid");
    }
  }

  void check_relaxing_charge() const {
    const ElectricScene& electric = *scene_.electric;
    if (electric.initial_potential == InitialPotential::file) {
      refuse("electric", "initial_Vm",
             "\"initial_Vm\" in [electric] is file, but with \"displacement_current\" the charges of both faces count, "
             "which "
             "no file has; accepted: zero, steady");
    }
    if (electric.initial_potential == InitialPotential::steady &&
        (electric.conductivity_in == 0.0 || electric.conductivity_out == 0.0)) {
      refuse("electric", "initial_Vm",
             "\"initial_Vm\" in [electric] is steady, but a conductivity is 0; accepted with \"displacement_current\": "
             "zero");
    }
  }

  void check_average() const {
    if (scene_.electric->initial_potential != InitialPotential::zero) {
      refuse("electric", "initial_Vm",
             "\"initial_Vm\" in [electric] has no effect with \"average\" in [electric.waveform]; accepted: zero");
    }
    if (scene_.electric->waveform->phase != 0.0) {
      refuse("electric.waveform", "phase",
             "\"phase\" in [electric.waveform] has no effect with \"average\"; accepted: 0");
    }
  }

  void check_waveform(const std::string& table, const WaveformScene& waveform) const {
    switch (waveform.kind) {
      case WaveformKind::dc:
      case WaveformKind::ac:
      case WaveformKind::pulse:
        break;
      case WaveformKind::pulse_train:
        if (waveform.period > waveform.duration) break;
        refuse(table, "period",
               fmt::format("\"period\" in [{}] is {:g}; accepted: more than the duration {:g}", table, waveform.period,
                           waveform.duration));
      case WaveformKind::table:
        check_waveform_table(table, waveform);
    }
  }

  /// Of fixed steps.
  void check_periods() const {
    if (!scene_.numerics.dt) return;
    for (const ActingWaveform& acting : acting_waveforms(scene_)) {
      if (acting.waveform->kind != WaveformKind::ac) continue;
      const double steps = 1.0 / (acting.waveform->frequency * *scene_.numerics.dt);
      if (steps >= fewest_fixed_steps_a_period) continue;
      refuse(acting.table, "frequency",
             fmt::format("\"dt\" in [numerics] takes {:.3g} steps a period of [{}]; accepted: at least {:g}", steps,
                         acting.table, fewest_fixed_steps_a_period));
    }
  }

  void check_waveform_table(const std::string& table, const WaveformScene& waveform) const {
    const auto refuse_times = [&](const std::string& problem) {
      refuse(table, "times", fmt::format("the table of [{}] {}", table, problem));
    };
    const auto& times = waveform.times;
    if (times.size() != waveform.values.size()) {
      refuse_times(
          fmt::format("has {} times and {} values; accepted: as many of either", times.size(), waveform.values.size()));
    }
    if (times.size() < 2) refuse_times(fmt::format("has {} entries; accepted: at least 2", times.size()));
    const auto fall = std::is_sorted_until(times.begin(), times.end());
    if (fall != times.end()) refuse_times(fmt::format("falls to the time {:g}; accepted: ascending times", *fall));
    for (std::size_t i = 2; i < times.size(); ++i) {
      if (times[i] == times[i - 2]) {
        refuse_times(fmt::format("has the time {:g} three times; accepted: twice, which makes a jump", times[i]));
      }
    }
  }

  void check_placement() const {
    const ShapeScene& shape = scene_.shape;
    if (shape.area && shape.scale) {
      refuse("shape", "scale", "\"scale\" in [shape] together with \"area\"; accepted: one of them");
    }
    if (shape.rotation && (*shape.rotation)[0] == 0.0 && (*shape.rotation)[1] == 0.0 && (*shape.rotation)[2] == 0.0) {
      refuse("shape", "rotation", "\"rotation\" in [shape] has the axis 0, 0, 0; accepted: an axis that is not zero");
    }
  }

  void check_radial_shape() const {
    const ShapeScene& shape = scene_.shape;
    // The effective scene spells out every default.
    if (!shape.amplitude && shape.exponent != ShapeScene{}.exponent) {
      refuse("shape", "exponent", "\"exponent\" in [shape] has no effect without \"amplitude\"");
    }
    for (std::size_t i = 0; i < shape.modes.size(); ++i) {
      if (shape.modes[i].n <= scene_.numerics.order) continue;
      const toml::node& entry = *table_["shape"]["modes"][i].node();
      throw InputError(
          fmt::format("{}: \"modes\" in [shape] has the degree n = {}; accepted: at most the degree {} of [numerics]",
                      place(entry, file_), shape.modes[i].n, scene_.numerics.order));
    }
    const Extremes radius = radius_extremes(scene_);
    if (!(radius.least > 0.0)) {
      refuse(
          "shape", "modes",
          fmt::format("the radius in [shape] falls to {}; accepted: > 0 and finite in every direction", radius.least));
    }
    if (!size_range.contains(radius.least) || !size_range.contains(radius.most)) {
      refuse("shape", "modes",
             fmt::format("the radius in [shape] is {:.3g} to {:.3g}; accepted: {}", radius.least, radius.most,
                         size_range.text()));
    }
  }

  void check_gradient() const {
    const TripleOfTriples& gradient = scene_.flow->gradient;
    double largest = 0.0;
    for (const Triple& row : gradient) {
      for (const double entry : row) largest = std::max(largest, std::abs(entry));
    }
    const double trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
    if (!(std::abs(trace) <= trace_tolerance * largest)) {
      refuse("flow", "gradient",
             fmt::format("\"gradient\" in [flow] has the trace {}; accepted: 0 (incompressible flow)", trace));
    }
  }

  void check_conductivities() const {
    if (scene_.electric->conductivity_in == 0.0 && scene_.electric->conductivity_out == 0.0) {
      refuse("electric", "conductivity_in",
             "\"conductivity_in\" and \"conductivity_out\" in [electric] are both 0; accepted: at least one > 0");
    }
  }

  void check_steps() const {
    const NumericsScene& numerics = scene_.numerics;
    if (!numerics.dt && !numerics.tolerance) {
      refuse("numerics", "dt",
             "missing key \"dt\" in [numerics] (largest time step); accepted: > 0, or a \"tolerance\"");
    }
    if (numerics.tolerance && numerics.time_order < 2) {
      refuse("numerics", "time_order",
             "\"time_order\" in [numerics] is 1, which has no error estimate; accepted with a tolerance: 2 to 5");
    }
  }

  /// Blames the key that asks for most of them.
  void require_few_steps() const {
    const NumericsScene& numerics = scene_.numerics;
    struct Demand {
      std::string_view table, key;
      double steps;
    };
    std::vector<Demand> demands;
    if (numerics.dt) demands.push_back({"numerics", "dt", numerics.end_time / *numerics.dt});
    for (const ActingWaveform& acting : acting_waveforms(scene_)) {
      demands.push_back(
          {acting.table, steps_key(acting.waveform->kind), fewest_steps(*acting.waveform, numerics.end_time)});
    }
    double steps = 0.0;
    for (const Demand& demand : demands) steps += demand.steps;
    if (steps <= most_steps) return;
    const Demand& largest = *std::ranges::max_element(demands, {}, &Demand::steps);
    refuse(largest.table, largest.key,
           fmt::format("\"{}\" in [{}] asks for {:.3g} steps; accepted: at most {:g}", largest.key, largest.table,
                       largest.steps, most_steps));
  }

  /// The key of a waveform on which its steps depend.
  static std::string_view steps_key(WaveformKind kind) {
    if (kind == WaveformKind::ac) return "frequency";
    return kind == WaveformKind::pulse_train ? "period" : "kind";
  }

  void check_counts() const {
    const NumericsScene& numerics = scene_.numerics;
    require_few_steps();
    const OutputScene& output = scene_.output;
    double count = output.every ? numerics.end_time / *output.every : 0.0;
    const auto require_few = [&](std::string_view key) {
      if (count <= most_snapshots) return;
      refuse("output", key,
             fmt::format("\"{}\" in [output] asks for {:.3g} snapshots; accepted: at most {:g}", key, count,
                         most_snapshots));
    };
    require_few("every");
    for (const OutputWindow& window : output.windows) {
      count += std::max(0.0, std::min(window.to, numerics.end_time) - window.from) / window.every;
    }
    require_few("window");
    count += static_cast<double>(output.times.size());
    require_few("times");
  }

  void check_output() const {
    const OutputScene& output = scene_.output;
    const auto fall = std::is_sorted_until(output.times.begin(), output.times.end());
    if (fall != output.times.end()) {
      refuse("output", "times", fmt::format("\"times\" in [output] falls to {:g}; accepted: ascending times", *fall));
    }
    if (output.units == ResultUnits::si && !scene_.units) {
      refuse("output", "units", "\"units\" in [output] is \"si\", but the scene has no table [units]");
    }
  }

  /// Before any count of theirs.
  void check_windows() const {
    for (const OutputWindow& window : scene_.output.windows) {
      if (window.every > 0.0 && window.to > window.from) continue;
      refuse("output", "window",
             fmt::format("\"window\" in [output] goes from {:g} to {:g} every {:g}; accepted: a later \"to\" and an "
                         "\"every\" > 0",
                         window.from, window.to, window.every));
    }
  }

  const Scene& scene_;
  const toml::table& table_;
  const std::string& file_;
  bool is_heavy_;  ///< something else has a weight
};

}  // namespace

void check_scene(const Scene& scene, const toml::table& table, const std::string& file, bool is_heavy) {
  Checks(scene, table, file, is_heavy).run();
}

void check_shape_size(const Scene& scene, const toml::table& table, const std::string& file) {
  // About its own centre: the volume of a far shape would have no digits left.
  Scene centred = scene;
  centred.shape.centre = {};
  const ShapeSize size = size_of(initial_position(centred));
  const auto is_accepted = [](double value) { return value > 0.0 && std::isfinite(value); };
  if (is_accepted(size.area) && is_accepted(size.volume)) return;
  throw InputError(
      fmt::format("{}: the shape in [shape] has the area {:g} and the volume {:g}; accepted: > 0 and finite",
                  place(*table.get("shape"), file), size.area, size.volume));
}

void check_symmetry(const Scene& scene, const toml::table& table, const std::string& file) {
  if (scene.numerics.symmetry != SymmetryUse::axisymmetric) return;
  const Problem found = problem_of(scene);
  if (found.symmetry.axisymmetric) return;
  throw InputError(fmt::format(
      "{}: \"symmetry\" in [numerics] is axisymmetric, but shape, flow and field are not so about one axis; they have: "
      "{}",
      place(*table["numerics"]["symmetry"].node(), file), symmetry_text(found.symmetry, found.frame)));
}

}  // namespace vehd
