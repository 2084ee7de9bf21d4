#include "bie/fit/model_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "bie/fit/run_values.hpp"
#include "bie/runs/sweep/sweep_work.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/units.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Sets snapshots and end of a run to the times of its data, because only these rows are read.
void end_at_data(Scene& scene, const Experiment& experiment, const DataOfRun& of_run) {
  const double second = scene.units ? si_scale(scene.units, "time") : 1.0;
  for (const std::size_t i : of_run.data) scene.output.times.push_back(experiment.data[i].time / second);
  std::vector<double>& times = scene.output.times;
  std::ranges::sort(times);
  times.erase(std::unique(times.begin(), times.end()), times.end());
  scene.numerics.end_time = times.back();
  scene.numerics.until = RunsUntil::end_time;
}

}  // namespace

ModelRuns::ModelRuns(const std::vector<Experiment>& experiments, RunWork work, Interruption& interruption)
    : experiments_(experiments), work_(std::move(work)), interruption_(interruption) {
  make_directory(SweepPaths{work_.directory}.runs());
  lock_ = std::make_unique<DirectoryLock>(RunPaths{work_.directory}.lock());
}

SweepRun ModelRuns::run_of(const Experiment& experiment, const DataOfRun& data,
                           const std::vector<std::string>& point) const {
  SweepRun run;
  run.source = experiment.source;
  run.source.settings.insert(run.source.settings.end(), point.begin(), point.end());
  if (!data.setting.empty()) run.source.settings.push_back(data.setting);
  try {
    Scene scene = at_tolerance(read_scene(run.source), experiment.tolerance);
    scene.numerics.error_bars = false;
    scene.output = {};
    scene.output.units = ResultUnits::dimensionless;
    if (experiment.measured.is_against_time()) end_at_data(scene, experiment, data);
    run.name = hash_of(effective_scene(scene));
    run.scene = std::move(scene);
  } catch (const InputError& error) {
    run.refusal = error.what();
  }
  return run;
}

void ModelRuns::compute(const std::vector<SweepRun>& runs) const {
  const SweepPaths paths{work_.directory};
  const auto is_left = [&](const SweepRun& run) { return run.scene && !has_result(paths.run(run)); };
  const auto n_left = std::ranges::count_if(runs, is_left);
  if (n_left == 0) return;
  const int n_workers = std::clamp<int>(static_cast<int>(n_left), 1, work_.n_workers);
  const std::string problem =
      run_sweep({paths, runs, n_workers, work_.n_threads, work_.report_progress}, interruption_);
  if (!problem.empty()) throw Interrupted(problem);
}

std::vector<Prediction> ModelRuns::predict(const std::vector<std::vector<std::string>>& points) const {
  std::vector<SweepRun> runs;
  for (const std::vector<std::string>& point : points) {
    for (const Experiment& experiment : experiments_) {
      for (const DataOfRun& data : experiment.runs) runs.push_back(run_of(experiment, data, point));
    }
  }
  compute(runs);
  std::vector<Prediction> predictions;
  auto run = runs.begin();
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::vector<double> values;
    std::string problem;
    for (const Experiment& experiment : experiments_) {
      const std::size_t first = values.size();
      values.resize(first + experiment.data.size());
      for (const DataOfRun& data : experiment.runs) {
        try {
          const std::vector<double> of_run = values_of_run(experiment, data, *run++, work_.directory);
          for (std::size_t k = 0; k < of_run.size(); ++k) values[first + data.data[k]] = of_run[k];
        } catch (const InputError& error) {
          problem = error.what();
        }
      }
    }
    predictions.push_back(problem.empty() ? Prediction{Eigen::Map<const Vector>(values.data(), std::ssize(values)), ""}
                                          : Prediction{std::nullopt, problem});
  }
  return predictions;
}

std::vector<std::string> ModelRuns::verdicts(const Experiment& experiment,
                                             const std::vector<std::string>& point) const {
  std::vector<std::string> verdicts;
  for (const DataOfRun& data : experiment.runs) {
    const auto result = read_result(SweepPaths{work_.directory}.run(run_of(experiment, data, point)));
    if (result && std::ranges::find(verdicts, result->verdict) == verdicts.end()) verdicts.push_back(result->verdict);
  }
  return verdicts;
}

}  // namespace vehd
