#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "bie/fit/fit.hpp"

/// The files of a fit.
namespace vehd {

/// Paths of the files of a fit.
struct FitPaths {
  std::filesystem::path directory;

  [[nodiscard]] std::filesystem::path json() const { return directory / "fit.json"; }
  [[nodiscard]] std::filesystem::path table() const { return directory / "fit.csv"; }
  [[nodiscard]] std::filesystem::path picture() const { return directory / "fit.png"; }
  /// Scene of the best fit: best.toml, or best_NAME.toml if there are several experiments.
  [[nodiscard]] std::filesystem::path best(const FitFile& fit, const Experiment& experiment) const;
};

/// Content of fit.json: values, errors and units by key, intervals, correlation, undetermined combinations, keys
/// at an end of their intervals, chi2, degrees_of_freedom, converged, evaluations, verdicts.
nlohmann::json json_of(const FitFile& fit, const FitResult& result);

/// One row for each datum: experiment, abscissa, its value, φ of a contour, quantity, datum, deviation, model, and the
/// difference of datum and model in deviations. Numbers are in the units of the data.
std::string fit_table(const FitFile& fit, const FitResult& result);

/// Scene of an experiment with the best-fitting values and every default spelled out.
std::string best_scene(const FitFile& fit, const FitResult& result, const Experiment& experiment);

/// A combination in words: "membrane.bending_modulus × 1.42, fluid.viscosity × 1.42".
std::string text_of(const FitFile& fit, const Combination& combination);

/// Writes fit.json, fit.csv and the scenes.
/// @throws OutputError
void write_fit(const FitPaths& paths, const FitFile& fit, const FitResult& result);

}  // namespace vehd
