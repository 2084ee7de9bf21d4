#include "bie/fit/synthesis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "bie/fit/noise.hpp"
#include "bie/scene/key_lookup.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// A number with a unit of the quantity, in SI base units.
double given_size(const Experiment& experiment, const std::string& text, const std::string& option) {
  const auto quantity = parse_quantity(text);
  if (!quantity || !(quantity->number > 0.0)) {
    throw InputError(fmt::format("{} {}: accepted: a number above 0{}", option, shortened(text),
                                 experiment.measured.unit.empty() ? "" : " with its unit, \"2 mV\""));
  }
  return quantity->number *
         unit_factor(experiment.scene, experiment.measured.dimension, quantity->unit, option + " " + text);
}

/// Times of the snapshots of a scene, in its output unit of time.
std::vector<std::string> times_of(const Scene& scene) {
  const double end = scene.numerics.end_time;
  std::vector<double> times = events_of(scene).snapshots.between(0.0, end);
  times.insert(times.begin(), 0.0);
  if (end > 0.0) times.push_back(end);
  std::vector<std::string> texts;
  for (const double time : times) texts.push_back(fmt::format("{:.12g}", time * OutputUnits(scene).of("time").factor));
  return texts;
}

/// Values of the varied key without their unit.
std::vector<std::string> values_of(const Synthesis& synthesis, const Scene& scene, std::string& unit) {
  const std::string option = "--vary " + synthesis.key;
  const KeyDescription& key = *keys_named(synthesis.key, option, "a scene").front();
  std::vector<std::string> texts;
  for (const std::string& value : synthesis.values) {
    const auto quantity = parse_quantity(value);
    if (!quantity || (!texts.empty() && quantity->written != unit)) {
      throw InputError(
          fmt::format("{}: has the value \"{}\"; accepted: numbers of one unit", option, shortened(value)));
    }
    unit = quantity->written;
    texts.push_back(fmt::format("{}", quantity->number));
  }
  unit_factor(scene, std::string(key.unit), unit, option);
  return texts;
}

}  // namespace

Experiment experiment_of(const Synthesis& synthesis) {
  Experiment experiment;
  experiment.source = synthesis.source;
  experiment.scene = read_scene(synthesis.source);
  Measured& measured = experiment.measured;
  measured.quantity = synthesis.quantity;
  measured.dimension = dimension_of(experiment.scene, synthesis.quantity, "--quantity " + synthesis.quantity);
  if (!measured.is_contour() && (synthesis.n_angles || !synthesis.pixel.empty())) {
    throw InputError(fmt::format("--quantity {}: has no angles and pixels; accepted with {}: contour",
                                 synthesis.quantity, synthesis.n_angles ? "--angles" : "--pixel"));
  }
  const OutputUnits units(experiment.scene);
  measured.unit = units.of(measured.dimension).symbol;
  if (experiment.scene.units)
    measured.factor = unit_factor(experiment.scene, measured.dimension, measured.unit, "--quantity");
  std::vector<std::string> abscissae;
  if (synthesis.key.empty()) {
    measured.abscissa_unit = units.of("time").symbol;
    measured.abscissa_factor = unit_factor(experiment.scene, "time", measured.abscissa_unit, "--quantity");
    abscissae = times_of(experiment.scene);
  } else {
    measured.abscissa = synthesis.key;
    abscissae = values_of(synthesis, experiment.scene, measured.abscissa_unit);
  }
  double variance = std::pow(given_size(experiment, synthesis.noise, "--noise"), 2);
  if (measured.is_contour() && !synthesis.pixel.empty()) {
    variance += std::pow(given_size(experiment, synthesis.pixel, "--pixel"), 2) / 12.0;
  }
  const int n_angles = measured.is_contour() ? synthesis.n_angles.value_or(64) : 1;
  for (const std::string& at : abscissae) {
    for (int k = 0; k < n_angles; ++k) {
      Datum datum{.at = at, .angle_deg = 360.0 * k / n_angles, .deviation = std::sqrt(variance)};
      if (measured.is_against_time()) datum.time = measured.abscissa_factor * parse_quantity(at)->number;
      experiment.data.push_back(datum);
    }
  }
  experiment.runs = runs_of(measured, experiment.data);
  return experiment;
}

Vector simulated_values(Experiment experiment, const RunWork& work, Interruption& interruption) {
  constexpr double run_error_share = 0.01;
  std::vector<Experiment> experiments = {std::move(experiment)};
  Experiment& only = experiments.front();
  const ModelRuns runs(experiments, work, interruption);
  Vector values;
  for (const double tolerance : {loosest_tolerance, 0.0}) {
    only.tolerance = tolerance > 0.0 ? tolerance : tolerance_for(only.data, run_error_share);
    if (only.tolerance <= tightest_tolerance) {
      throw InputError(fmt::format("--noise: is too small for runs; accepted: more than {:g} of the largest value",
                                   tightest_tolerance / run_error_share));
    }
    Prediction prediction = runs.predict({{}}).front();
    if (!prediction.values) {
      throw InputError(fmt::format("{}: {}", only.source.file.string(), prediction.problem));
    }
    values = std::move(*prediction.values);
    for (std::size_t i = 0; i < only.data.size(); ++i) only.data[i].value = values[static_cast<Index>(i)];
  }
  return values;
}

std::string synthetic_data(const Synthesis& synthesis, const Experiment& experiment, const Vector& prediction) {
  const Measured& measured = experiment.measured;
  const double noise = given_size(experiment, synthesis.noise, "--noise");
  const double pixel = synthesis.pixel.empty() ? 0.0 : given_size(experiment, synthesis.pixel, "--pixel");
  const std::string unit = measured.unit.empty() ? "" : fmt::format(" [{}]", measured.unit);
  std::vector<std::string> header = {measured.abscissa_header()};
  if (measured.is_contour()) header.emplace_back(contour_angle);
  header.push_back(measured.header());
  header.push_back(deviation_column + unit);
  std::string text = csv_line(header);
  NormalNumbers normal(synthesis.seed);
  for (std::size_t i = 0; i < experiment.data.size(); ++i) {
    const Datum& datum = experiment.data[i];
    double value = prediction[static_cast<Index>(i)] + noise * normal(), angle_deg = datum.angle_deg;
    if (pixel > 0.0) {
      const double angle = angle_deg * std::numbers::pi / 180.0;
      const double x = pixel * std::round(value * std::cos(angle) / pixel);
      const double z = pixel * std::round(value * std::sin(angle) / pixel);
      value = std::hypot(x, z);
      angle_deg = std::fmod(std::atan2(z, x) * 180.0 / std::numbers::pi + 360.0, 360.0);
    }
    std::vector<std::string> cells = {datum.at};
    if (measured.is_contour()) cells.push_back(fmt::format("{:.9g}", angle_deg));
    cells.push_back(fmt::format("{:.9g}", value / measured.factor));
    cells.push_back(fmt::format("{:.6g}", datum.deviation / measured.factor));
    text += csv_line(cells);
  }
  return text;
}

}  // namespace vehd
