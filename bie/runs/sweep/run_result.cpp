#include "bie/runs/sweep/run_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

#include "bie/files/json_text.hpp"
#include "bie/runs/sweep/worker_id.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
namespace {

std::filesystem::path result_file(const std::filesystem::path& directory) { return directory / "result.json"; }

/// First and last line of a file.
std::array<std::string, 2> outer_lines(const std::filesystem::path& path) {
  std::string text = text_of_file(path);
  while (text.ends_with('\n')) text.pop_back();
  const std::size_t first_end = text.find('\n'), last_start = text.rfind('\n');
  if (first_end == std::string::npos) throw InputError(fmt::format("{}: holds no row", path.string()));
  return {text.substr(0, first_end), text.substr(last_start + 1)};
}

}  // namespace

RunResult result_of(const RunPaths& paths, const nlohmann::json& summary, double seconds) {
  RunResult result;
  result.verdict = summary.value("verdict", "");
  result.reason = summary.value("reason", "");
  result.seconds = seconds;
  const auto [header, last] = outer_lines(paths.history());
  const std::vector<std::string> names = csv_cells(header), values = csv_cells(last);
  for (std::size_t i = 0; i < std::min(names.size(), values.size()); ++i) {
    // "time [ms]", or the name alone.
    const std::size_t unit = names[i].find(" [");
    const std::string name = names[i].substr(0, unit);
    result.final_values[name] = values[i];
    if (unit != std::string::npos) result.units[name] = names[i].substr(unit + 2, names[i].size() - unit - 3);
  }
  return result;
}

void write_result(const std::filesystem::path& directory, const RunResult& result) {
  const nlohmann::json json{{"verdict", result.verdict},
                            {"reason", result.reason},
                            {"seconds", result.seconds},
                            {"final", result.final_values},
                            {"units", result.units}};
  replace_file(result_file(directory), json_text(json));
}

std::optional<RunResult> read_result(const std::filesystem::path& directory) {
  const nlohmann::json json = nlohmann::json::parse(text_of_file(result_file(directory)), nullptr, false);
  if (!json.is_object()) return std::nullopt;
  try {
    RunResult result{json.at("verdict"), json.at("reason"), json.at("seconds"), {}, {}};
    json.at("final").get_to(result.final_values);
    json.at("units").get_to(result.units);
    return result;
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

bool has_result(const std::filesystem::path& directory) {
  std::error_code ignored;
  return std::filesystem::exists(result_file(directory), ignored);
}

void replace_shared_file(const std::filesystem::path& path, const std::string& text) {
  const TemporaryFile temporary(path.parent_path() /
                                fmt::format(".{}.{}", path.filename().string(), text_of(this_worker())));
  replace_file(temporary.path(), text);
  rename_file(temporary.path(), path);
}

}  // namespace vehd
