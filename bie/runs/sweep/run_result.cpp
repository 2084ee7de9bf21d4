#include "bie/runs/sweep/run_result.hpp"

#include <fmt/format.h>

#include "bie/files/json_text.hpp"
#include "bie/runs/history.hpp"
#include "bie/runs/sweep/worker_id.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/temporary.hpp"

namespace vehd {
namespace {

std::filesystem::path result_file(const std::filesystem::path& directory) { return directory / "result.json"; }

}  // namespace

RunResult result_of(const RunPaths& paths, const nlohmann::json& summary, double seconds) {
  RunResult result;
  result.verdict = summary.value("verdict", "");
  result.reason = summary.value("reason", "");
  result.seconds = seconds;
  // The session has just written it or compared it with its checkpoint.
  const HistoryTable history(paths.history());
  if (history.n_rows() == 0) throw InputError(fmt::format("{}: holds no row", paths.history().string()));
  for (const std::string& name : history.names()) {
    result.final_values[name] = fmt::format("{:.17g}", history.column(name).back());
    if (!history.unit(name).empty()) result.units[name] = history.unit(name);
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
