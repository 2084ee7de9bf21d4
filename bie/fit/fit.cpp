#include "bie/fit/fit.hpp"

#include <utility>

namespace vehd {
namespace {

std::vector<std::string> settings_at(const std::vector<FreeKey>& keys, const Vector& point) {
  std::vector<std::string> settings;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    settings.push_back(keys[k].setting_of(keys[k].number_of(point[static_cast<Index>(k)])));
  }
  return settings;
}

}  // namespace

std::vector<std::string> FitResult::settings(const FitFile& fit) const { return settings_at(fit.keys, minimum.point); }

LeastSquares least_squares_of(const FitFile& fit) {
  std::vector<double> data, deviations;
  for (const Experiment& experiment : fit.experiments) {
    for (const Datum& datum : experiment.data) {
      data.push_back(datum.value);
      deviations.push_back(datum.deviation);
    }
  }
  LeastSquares problem;
  problem.data = Eigen::Map<const Vector>(data.data(), std::ssize(data));
  problem.deviations = Eigen::Map<const Vector>(deviations.data(), std::ssize(data));
  problem.run_error = run_error_in_deviations(data.size());
  const Index n = std::ssize(fit.keys);
  problem.lower = problem.upper = problem.start = Vector(n);
  for (Index k = 0; k < n; ++k) {
    const FreeKey& key = fit.keys[static_cast<std::size_t>(k)];
    problem.lower[k] = key.coordinate_of(key.from);
    problem.upper[k] = key.coordinate_of(key.to);
    problem.start[k] = key.coordinate_of(key.start);
  }
  return problem;
}

FitResult fit_keys(const FitFile& fit, const ModelRuns& runs, std::function<void(int, double)> report_progress) {
  LeastSquares problem = least_squares_of(fit);
  problem.report_progress = std::move(report_progress);
  problem.model = [&](const std::vector<Vector>& points) {
    std::vector<std::vector<std::string>> settings;
    for (const Vector& point : points) settings.push_back(settings_at(fit.keys, point));
    return runs.predict(settings);
  };
  FitResult result;
  result.minimum = minimum_of(problem);
  std::vector<Combination> undetermined = undetermined_combinations(problem, result.minimum);
  result.statistics = statistics_of(result.minimum.jacobian, std::move(undetermined), result.minimum.at_end);
  for (std::size_t k = 0; k < fit.keys.size(); ++k) {
    result.values.push_back(fit.keys[k].number_of(result.minimum.point[static_cast<Index>(k)]));
  }
  for (const Experiment& experiment : fit.experiments) {
    result.verdicts.push_back(runs.verdicts(experiment, result.settings(fit)));
  }
  return result;
}

}  // namespace vehd
