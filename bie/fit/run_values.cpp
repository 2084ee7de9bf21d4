#include "bie/fit/run_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bie/files/run_reader.hpp"
#include "bie/geometry/surface.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/sweep/sweep_table.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/grid.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/stepping/evaluation/diagnose.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

double scale_of(const Scene& scene, const std::string& dimension) {
  return scene.units ? si_scale(scene.units, dimension) : 1.0;
}

/// Row nearest to a time; at a jump the second of its two rows.
std::size_t row_at(const std::vector<double>& times, double time) {
  std::size_t nearest = 0;
  for (std::size_t row = 1; row < times.size(); ++row) {
    if (std::abs(times[row] - time) <= std::abs(times[nearest] - time)) nearest = row;
  }
  return nearest;
}

std::vector<double> columns_of_history(const Experiment& experiment, const DataOfRun& data, const Scene& scene,
                                       const RunPaths& paths) {
  const HistoryTable history(paths.history());
  const std::vector<double>&column = history.column(experiment.measured.quantity), &times = history.column("time");
  const double scale = scale_of(scene, experiment.measured.dimension), second = scale_of(scene, "time");
  std::vector<double> values;
  for (const std::size_t i : data.data) {
    const bool is_against_time = experiment.measured.is_against_time();
    const std::size_t row = is_against_time ? row_at(times, experiment.data[i].time / second) : times.size() - 1;
    values.push_back(scale * column[row]);
  }
  return values;
}

std::vector<double> radii_of_snapshots(const Experiment& experiment, const DataOfRun& data, const Scene& scene,
                                       const RunPaths& paths) {
  const RunReader run(paths.snapshots());
  const double length = scale_of(scene, "length"), second = scale_of(scene, "time");
  std::vector<double> values(data.data.size());
  // All angles of a frame at once.
  for (const double time : scene.output.times.empty() ? std::vector{run.times().back()} : scene.output.times) {
    std::vector<std::size_t> of_frame;
    std::vector<double> angles;
    for (std::size_t k = 0; k < values.size(); ++k) {
      const Datum& datum = experiment.data[data.data[k]];
      if (experiment.measured.is_against_time() && datum.time / second != time) continue;
      of_frame.push_back(k);
      angles.push_back(datum.angle_deg);
    }
    const std::vector<double> radii = section_radii(run.snapshot(run.nearest(time)).coefficients("x", 3), angles);
    for (std::size_t k = 0; k < radii.size(); ++k) values[of_frame[k]] = length * radii[k];
  }
  return values;
}

}  // namespace

std::vector<double> values_of_run(const Experiment& experiment, const DataOfRun& data, const SweepRun& run,
                                  const std::filesystem::path& directory) {
  if (!run.scene) throw InputError(run.refusal);
  const RunPaths paths{SweepPaths{directory}.run(run)};
  const auto result = read_result(paths.directory);
  if (!result) throw InputError(fmt::format("{}: has no result", paths.directory.string()));
  if (!result->reason.empty()) throw InputError(fmt::format("{}: {}", paths.directory.string(), result->reason));
  std::vector<double> values = experiment.measured.is_contour()
                                   ? radii_of_snapshots(experiment, data, *run.scene, paths)
                                   : columns_of_history(experiment, data, *run.scene, paths);
  if (!std::ranges::all_of(values, [](double value) { return std::isfinite(value); })) {
    throw InputError(fmt::format("{}: \"{}\" is not a number", paths.directory.string(), experiment.measured.quantity));
  }
  return values;
}

std::vector<double> section_radii(const Matrix& position, const std::vector<double>& angles_deg) {
  const int order = order_of(position.rows());
  const SphereTransform transform(order, make_grid(2 * order));
  // Relative to the mean of x, as values_at_poles requires.
  Matrix x = position;
  x.row(0).setZero();
  const Vector3 centre = centroid(make_surface(transform, x));
  std::vector<double> radii;
  for (const double angle_deg : angles_deg) {
    const double angle = angle_deg * std::numbers::pi / 180.0;
    const Vector3 direction(std::cos(angle), 0.0, std::sin(angle));
    const double height = values_at_poles(direction, transform, centre, x, x * direction)[0];
    if (!std::isfinite(height)) {
      throw InputError(fmt::format("the section has no radius at phi = {} degrees", angle_deg));
    }
    radii.push_back(height - centre.dot(direction));
  }
  return radii;
}

}  // namespace vehd
