#include "bie/runs/sweep/sweep_runs.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"

namespace vehd {

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
    run.source.file = sweep.scene_file;
    for (std::size_t k = 0; k < sweep.keys.size(); ++k) {
      run.source.settings.push_back(fmt::format("{}={}", sweep.keys[k].name, run.values[k].toml));
    }
    try {
      run.scene = read_scene(run.source);
      run.name = hash_of(effective_scene(*run.scene));
    } catch (const InputError& error) {
      run.scene.reset();
      run.refusal = error.what();
    }
  }
  return runs;
}

std::vector<HistoryColumn> columns_of(const SweepFile& sweep) {
  std::vector<SweepColumn> wanted = {
      {"time"}, {"reduced_volume"}, {"aspect_ratio"}, {"inclination_deg"}, {"bending_energy_scaled"}};
  if (sweep.scene.vesicles.size() > 1) wanted = {{"time"}, {"smallest_gap"}};
  if (!sweep.columns.empty()) wanted = sweep.columns;
  const std::vector<HistoryColumn>& known = history_columns(history_kind(sweep.scene));
  std::vector<HistoryColumn> columns;
  for (const SweepColumn& column : wanted) {
    const auto found = std::ranges::find(known, column.name, &HistoryColumn::name);
    if (found == known.end()) {
      std::vector<std::string_view> names;
      for (const HistoryColumn& other : known) names.push_back(other.name);
      throw InputError(fmt::format("{}: \"columns\" has \"{}\", which history.csv of this scene does not have; {}",
                                   column.place, shortened(column.name), suggestion(column.name, names)));
    }
    columns.push_back(*found);
  }
  return columns;
}

}  // namespace vehd
