#include "bie/bench/result.hpp"

#include <fmt/format.h>

#include "bie/bench/redraw.hpp"
#include "bie/files/json_text.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

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

}  // namespace vehd
