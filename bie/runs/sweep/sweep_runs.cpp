#include "bie/runs/sweep/sweep_runs.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::vector<std::string_view> usual_columns(const Scene& scene) {
  if (scene.vesicles.size() > 1) return {"time", "smallest_gap"};
  return {"time", "reduced_volume", "aspect_ratio", "inclination_deg", "bending_energy_scaled"};
}

}  // namespace

std::string hash_of(const std::string& text) {
  const auto* bytes = reinterpret_cast<const unsigned char*>(text.data());
  return fmt::format("{:08x}{:08x}", crc32_z(crc32_z(0, nullptr, 0), bytes, text.size()),
                     adler32_z(adler32_z(0, nullptr, 0), bytes, text.size()));
}

std::vector<SweepRun> runs_of(const SweepFile& sweep) {
  std::vector<SweepRun> runs(sweep.n_runs());
  for (std::size_t i = 0; i < runs.size(); ++i) {
    SweepRun& run = runs[i];
    run.values = sweep.values_of(i);
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
      run.settings.push_back(fmt::format("{}={}", sweep.keys[k].name, run.values[k].toml));
    }
    try {
      run.scene = read_scene(SceneSource{sweep.scene_file, run.settings});
      run.name = hash_of(effective_scene(*run.scene));
    } catch (const InputError& error) {
      run.scene.reset();
      run.refusal = error.what();
    }
  }
  return runs;
}

std::vector<HistoryColumn> columns_of(const SweepFile& sweep) {
  const std::vector<HistoryColumn>& known = history_columns(history_kind(sweep.scene));
  std::vector<HistoryColumn> columns;
  const auto find = [&](std::string_view name) { return std::ranges::find(known, name, &HistoryColumn::name); };
  for (const SweepColumn& column : sweep.columns) {
    const auto found = find(column.name);
    if (found == known.end()) {
      std::vector<std::string_view> names;
      for (const HistoryColumn& other : known) names.push_back(other.name);
      throw InputError(fmt::format("{}: \"columns\" has \"{}\", which history.csv of this scene has not; {}",
                                   column.place, shortened(column.name), suggestion(column.name, names)));
    }
    columns.push_back(*found);
  }
  if (!sweep.columns.empty()) return columns;
  for (const std::string_view name : usual_columns(sweep.scene)) {
    if (const auto found = find(name); found != known.end()) columns.push_back(*found);
  }
  return columns;
}

}  // namespace vehd
