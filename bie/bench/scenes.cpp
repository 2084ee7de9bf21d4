#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>

#include "bie/bench/benches.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr std::array kShownAtTheEnd{"extent_x", "extent_z", "bending_energy_scaled", "Vm_north", "inclination_deg"};

BenchTable empty_scenes_table() {
  BenchTable table{"rows",
                   {{"scene", "scene", "{}", false, 24},
                    {"order", "p"},
                    {"time", "time"},
                    {"steps", "steps"},
                    {"seconds", "seconds", "{:.2g}", true}}};
  for (const char* name : kShownAtTheEnd) table.columns.push_back({name, name, "{:.5g}"});
  return table;
}

/// Last number of a column, in the reference scales of the scene whatever the units of the file.
double last_number(const HistoryTable& history, const Scene& scene, std::string_view name) {
  const auto column = std::ranges::find(history_columns(), name, &HistoryColumn::name);
  return history.column(std::string(name)).back() / history.units(scene.units).of(column->dimension).factor;
}

/// Empty if the history, that of several vesicles, has no such column.
BenchCell last_cell(const HistoryTable& history, const Scene& scene, std::string_view name) {
  if (!history.has(std::string(name))) return {};
  return last_number(history, scene, name);
}

void draw(const RunPaths& paths, const std::string& name, const std::filesystem::path& folder,
          BenchObserver& observer) {
  try {
    for (const auto& picture : plot_run({paths, {}, paths.plots()}).pictures) {
      std::filesystem::copy_file(picture, folder / (name + "_" + picture.filename().string()),
                                 std::filesystem::copy_options::overwrite_existing);
    }
  } catch (const std::exception& error) {
    observer.warn(fmt::format("no pictures of {}: {}", name, error.what()));
  }
}

}  // namespace

BenchResult bench_scenes(const std::vector<std::filesystem::path>& scenes, const std::filesystem::path& pictures,
                         BenchObserver& observer) {
  BenchResult result{"scenes", machine_record(), 1, {}, {empty_scenes_table()}};
  observer.heading(result.tables.front());
  const auto on_status = [&observer](const RunStatus& status) { observer.status(status); };
  for (const auto& file : scenes) {
    const Scene scene = read_scene(file);
    const TemporaryFolder folder("vehd-bench");
    const RunPaths paths{folder.path()};
    Interruption interruption;
    const auto start = std::chrono::steady_clock::now();
    const RunOutcome outcome =
        simulate({scene, paths, std::nullopt, on_status, {}, longest_lag_of_files}, interruption);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (interruption.requested()) throw Interrupted("stopped by a signal at " + file.string());
    if (!outcome.completed) throw ConvergenceError(fmt::format("{}: {}", file.string(), outcome.reason));
    const HistoryTable history(paths.history());
    std::vector<BenchCell> row{file.filename().string(), std::int64_t{scene.numerics.order},
                               last_number(history, scene, "time"), history.n_steps(), spread_of({seconds})};
    for (const char* name : kShownAtTheEnd) row.push_back(last_cell(history, scene, name));
    add_row(result.tables.front(), std::move(row), observer);
    draw(paths, file.stem().string(), pictures, observer);
  }
  return result;
}

std::vector<std::filesystem::path> scene_files(const std::filesystem::path& place) {
  if (std::filesystem::is_regular_file(place)) return {place};
  std::vector<std::filesystem::path> scenes = files_ending(place, ".toml");
  if (scenes.empty()) {
    throw InputError(
        fmt::format("{}: no scenes; accepted: a folder of the source tree with scenes (*.toml)", place.string()));
  }
  return scenes;
}

}  // namespace vehd
