#include "bie/fit/fit_output.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "bie/files/json_text.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// JSON has no infinity.
nlohmann::json number_or_null(double number) {
  return std::isfinite(number) ? nlohmann::json(number) : nlohmann::json(nullptr);
}

/// Ends of the interval of ±`times` standard errors, symmetric in the coordinate.
nlohmann::json interval(const FreeKey& key, double number, double error, double times) {
  if (!std::isfinite(error)) return nullptr;
  const double p = key.coordinate_of(number);
  return {key.number_of(p - times * error), key.number_of(p + times * error)};
}

}  // namespace

std::filesystem::path FitPaths::best(const FitFile& fit, const Experiment& experiment) const {
  return directory / (fit.experiments.size() == 1 ? "best.toml" : fmt::format("best_{}.toml", experiment.name));
}

std::string text_of(const FitFile& fit, const Combination& combination) {
  const std::vector<Index> keys = combination.parameters();
  // The sign makes the first key increase.
  const double sign = combination.direction[keys.front()] < 0.0 ? -1.0 : 1.0;
  std::vector<std::string> names;
  for (const Index k : keys) {
    const double change = 0.5 * sign * combination.direction[k];
    const FreeKey& key = fit.keys[static_cast<std::size_t>(k)];
    names.push_back(key.is_logarithmic ? fmt::format("{} × {:.3g}", key.name, std::exp(change))
                                       : fmt::format("{} {:+.3g}{}{}", key.name, change * (key.to - key.from),
                                                     key.unit.empty() ? "" : " ", key.unit));
  }
  return fmt::format("{}", fmt::join(names, ", "));
}

nlohmann::json json_of(const FitFile& fit, const FitResult& result) {
  const Statistics& statistics = result.statistics;
  nlohmann::json values = nlohmann::json::object(), errors = values, units = values, one = values, two = values,
                 correlation = values, verdicts = values;
  for (std::size_t k = 0; k < fit.keys.size(); ++k) {
    const FreeKey& key = fit.keys[k];
    const double error = statistics.errors[static_cast<Index>(k)];
    values[key.name] = result.values[k];
    errors[key.name] = number_or_null(key.error_of(result.values[k], error));
    units[key.name] = key.unit.empty() ? "1" : key.unit;
    one[key.name] = interval(key, result.values[k], error, 1.0);
    two[key.name] = interval(key, result.values[k], error, 1.959964);
    for (std::size_t l = 0; l < fit.keys.size(); ++l) {
      correlation[key.name][fit.keys[l].name] =
          number_or_null(statistics.correlation(static_cast<Index>(k), static_cast<Index>(l)));
    }
  }
  nlohmann::json undetermined = nlohmann::json::array();
  for (const Combination& combination : statistics.undetermined) {
    nlohmann::json direction = nlohmann::json::object();
    for (const Index k : combination.parameters()) {
      direction[fit.keys[static_cast<std::size_t>(k)].name] = combination.direction[k];
    }
    undetermined.push_back(
        {{"direction", direction}, {"text", text_of(fit, combination)}, {"least_error", combination.least_error}});
  }
  nlohmann::json at_end = nlohmann::json::array();
  for (const Index k : result.minimum.at_end) at_end.push_back(fit.keys[static_cast<std::size_t>(k)].name);
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) verdicts[fit.experiments[i].name] = result.verdicts[i];
  return {{"values", values},
          {"errors", errors},
          {"units", units},
          {"intervals_68", one},
          {"intervals_95", two},
          {"correlation", correlation},
          {"undetermined", undetermined},
          {"at_end", at_end},
          {"chi2", result.minimum.chi2()},
          {"degrees_of_freedom", result.minimum.residuals.size() - std::ssize(fit.keys)},
          {"converged", result.minimum.converged},
          {"evaluations", result.minimum.n_evaluations},
          {"verdicts", verdicts}};
}

std::string fit_table(const FitFile& fit, const FitResult& result) {
  std::string text = csv_line(
      {"experiment", "abscissa", "at", contour_angle, "quantity", "data", deviation_column, "model", "residual"});
  Index i = 0;
  for (const Experiment& experiment : fit.experiments) {
    const Measured& measured = experiment.measured;
    for (const Datum& datum : experiment.data) {
      const auto number = [&](double value) { return fmt::format("{:.9g}", value / measured.factor); };
      text += csv_line({experiment.name, measured.abscissa_header(), datum.at,
                        measured.is_contour() ? fmt::format("{}", datum.angle_deg) : "", measured.header(),
                        number(datum.value), number(datum.deviation), number(result.minimum.model[i]),
                        fmt::format("{:.6g}", result.minimum.residuals[i])});
      ++i;
    }
  }
  return text;
}

std::string best_scene(const FitFile& fit, const FitResult& result, const Experiment& experiment) {
  SceneSource source = experiment.source;
  std::string text = "# The best fit:\n";
  for (const std::string& setting : result.settings(fit)) {
    source.settings.push_back(setting);
    text += fmt::format("#   {}\n", setting);
  }
  return text + "\n" + effective_scene(read_scene(source));
}

void write_fit(const FitPaths& paths, const FitFile& fit, const FitResult& result) {
  replace_file(paths.json(), json_text(json_of(fit, result)));
  replace_file(paths.table(), fit_table(fit, result));
  for (const Experiment& experiment : fit.experiments) {
    replace_file(paths.best(fit, experiment), best_scene(fit, result, experiment));
  }
}

}  // namespace vehd
