#include "bie/bench/result.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "bie/bench/benches.hpp"
#include "bie/bench/pages.hpp"
#include "bie/bench/panels.hpp"
#include "bie/files/json_text.hpp"
#include "bie/files/versions.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(std::min(line.size(), line.find(':') + 2));
  }
  return "unknown processor";
}

}  // namespace

MachineRecord machine_record() {
  return {processor(),           std::thread::hardware_concurrency(),
          omp_get_max_threads(), library_versions().at("compiler"),
          program_version(),     program_commit()};
}

nlohmann::ordered_json json_of(const MachineRecord& machine) {
  return {{"processor", machine.processor}, {"hardware_threads", machine.hardware_threads},
          {"threads", machine.threads},     {"compiler", machine.compiler},
          {"version", machine.version},     {"commit", machine.commit}};
}

std::string text_of(const MachineRecord& machine) {
  return fmt::format("{}, {} hardware thread{}, {}, vehd {}{}", machine.processor, machine.hardware_threads,
                     machine.hardware_threads == 1 ? "" : "s", machine.compiler, machine.version,
                     machine.commit.empty() ? "" : " at commit " + machine.commit);
}

void add_row(BenchTable& table, std::vector<BenchCell> row, BenchObserver& observer) {
  observer.row(table, row);
  table.rows.push_back(std::move(row));
}

std::string name_of_table(const BenchResult& result, std::size_t table) {
  return table == 0 ? result.name : result.name + "_" + result.tables[table].name;
}

nlohmann::ordered_json json_of(const BenchResult& result) {
  nlohmann::ordered_json json = {
      {"bench", result.name}, {"machine", json_of(result.machine)}, {"repeats", result.repeats}};
  if (result.facts.is_object()) json.update(result.facts);
  for (const BenchTable& table : result.tables) json[table.name] = json_of(table);
  return json;
}

nlohmann::ordered_json write_bench(const BenchResult& result, const BenchOutput& output, BenchObserver& observer) {
  make_directory(output.directory);
  const auto file = [&](const std::string& end) { return output.directory / (result.name + end); };
  nlohmann::ordered_json json = json_of(result);
  replace_file(file(".json"), json_text(json));
  for (std::size_t i = 0; i < result.tables.size(); ++i) {
    replace_file(output.directory / (name_of_table(result, i) + ".csv"), csv_of(result.tables[i]));
  }
  observer.note("files: " + file(".*").string());
  if (!output.plot) return json;
  for (std::size_t i = 0; i < result.tables.size(); ++i) {
    try {
      draw_record(output.directory / (name_of_table(result, i) + ".csv"));
    } catch (const std::exception& problem) {
      observer.warn(fmt::format("no picture: {}", problem.what()));
    }
  }
  return json;
}

namespace fs = std::filesystem;

fs::path draw_record(const fs::path& csv) {
  const std::vector<BenchPanel> panels = panels_of(csv.stem().string(), BenchRecord(csv));
  if (panels.empty()) return {};
  const fs::path picture = fs::path(csv).replace_extension(".png");
  draw_bench(panels, picture);
  return picture;
}

std::vector<fs::path> redraw(const fs::path& folder, const fs::path& docs) {
  std::vector<fs::path> pictures;
  for (const fs::path& csv : files_ending(folder, ".csv")) {
    const fs::path picture = draw_record(csv);
    if (picture.empty()) continue;
    pictures.push_back(picture);
    const std::string name = "bench_" + picture.filename().string();
    if (docs.empty() || !pages_mention(docs, "images/" + name)) continue;
    pictures.push_back(docs / "images" / name);
    fs::copy_file(picture, pictures.back(), fs::copy_options::overwrite_existing);
  }
  const fs::path stability = folder / "stability", runs = stability / "runs";
  if (fs::is_directory(runs)) {
    for (const auto& entry : fs::directory_iterator(runs)) {
      pictures.push_back(draw_case({entry.path()}, stability / "shapes"));
      const fs::path shown = docs / "images/hard_cases" / pictures.back().filename();
      if (docs.empty() || !fs::exists(shown)) continue;
      fs::copy_file(pictures.back(), shown, fs::copy_options::overwrite_existing);
      pictures.push_back(shown);
    }
  }
  if (pictures.empty()) throw InputError(fmt::format("{}: has no table of a bench (NAME.csv)", folder.string()));
  return pictures;
}

}  // namespace vehd
