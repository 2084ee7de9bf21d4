#include "bie/bench/result.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

void make_bench_directory(const BenchOutput& output) {
  std::error_code error;
  std::filesystem::create_directories(output.directory, error);
  if (error) throw OutputError(fmt::format("{}: cannot be created: {}", output.directory.string(), error.message()));
}

void announce(const BenchTable& table) {
  fmt::print("{}", heading_line(table));
  std::fflush(stdout);
}

void add_row(BenchTable& table, std::vector<BenchCell> row) {
  fmt::print("{}", row_line(table, row));
  std::fflush(stdout);
  table.rows.push_back(std::move(row));
}

nlohmann::ordered_json json_of(const BenchResult& result) {
  nlohmann::ordered_json json = {
      {"bench", result.name}, {"machine", json_of(result.machine)}, {"repeats", result.repeats}};
  if (result.facts.is_object()) json.update(result.facts);
  for (const BenchTable& table : result.tables) json[table.name] = json_of(table);
  return json;
}

nlohmann::ordered_json write_bench(const BenchResult& result, const BenchOutput& output) {
  make_bench_directory(output);
  const auto file = [&](const std::string& end) { return output.directory / (result.name + end); };
  nlohmann::ordered_json json = json_of(result);
  replace_file(file(".json"), json.dump(2) + "\n");
  for (std::size_t i = 0; i < result.tables.size(); ++i) {
    replace_file(file(i == 0 ? ".csv" : "_" + result.tables[i].name + ".csv"), csv_of(result.tables[i]));
  }
  fmt::print("files: {}\n", file(".*").string());
  if (!output.plot || result.panels.empty()) return json;
  try {
    draw_bench(file(".csv"), result.panels, file(".png"));
  } catch (const std::exception& problem) {
    spdlog::warn("no picture: {}", problem.what());
  }
  return json;
}

}  // namespace vehd
