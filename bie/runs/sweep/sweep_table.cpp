#include "bie/runs/sweep/sweep_table.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <set>

#include "bie/files/json_text.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

std::filesystem::path result_file(const std::filesystem::path& directory) { return directory / "result.json"; }

/// Replaces line breaks, as a cell is one line.
std::string table_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// Counter of the outcome of a run.
std::int64_t& counter_of(const std::optional<RunResult>& result, SweepCount& count) {
  if (!result) return count.unfinished;
  if (result->verdict == "refused") return count.refused;
  if (result->verdict == "crashed") return count.crashed;
  return result->reason.empty() ? count.completed : count.stopped;
}

/// Makes the table of a sweep from the available results.
class TableWriter {
 public:
  TableWriter(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs)
      : paths_(paths), sweep_(sweep), runs_(runs) {
    const OutputUnits units(sweep.scene);
    for (const HistoryColumn& column : columns_of(sweep)) {
      const std::string symbol = units.of(column.dimension).symbol;
      headers_.push_back(symbol.empty() ? std::string(column.name) : fmt::format("{} [{}]", column.name, symbol));
    }
  }

  [[nodiscard]] nlohmann::json description() const {
    nlohmann::json keys = nlohmann::json::array();
    for (const VariedKey& key : sweep_.keys) {
      keys.push_back({{"name", key.name}, {"scale", key.is_logarithmic ? "log" : "linear"}});
    }
    return {{"scene", std::filesystem::absolute(sweep_.scene_file).lexically_normal().string()},
            {"mode", sweep_.mode == SweepMode::zip ? "zip" : "grid"},
            {"keys", keys},
            {"columns", headers_},
            {"runs", sweep_.n_runs()}};
  }

  /// @param count  of its rows
  [[nodiscard]] std::string table(SweepCount& count) const {
    std::vector<std::string> header;
    for (const VariedKey& key : sweep_.keys) header.push_back(key.name);
    header.insert(header.end(), headers_.begin(), headers_.end());
    header.insert(header.end(), {"verdict", "reason", "seconds", "run"});
    std::string text = csv_line(header);
    std::set<std::string> counted;
    for (const SweepRun& run : runs_) {
      const std::optional<RunResult> result =
          run.scene ? read_result(paths_.run(run)) : RunResult{"refused", run.refusal};
      ++counter_of(result, count);
      // Rows with the same scene share a run.
      if (result && counted.insert(run.name).second) count.seconds += result->seconds;
      std::vector<std::string> cells;
      for (const VariedValue& value : run.values) cells.push_back(value.shown);
      for (const std::string& column : headers_) cells.push_back(result ? cell(*result, column) : "");
      cells.push_back(result ? table_line(result->verdict) : "unfinished");
      cells.push_back(result ? table_line(result->reason) : "");
      cells.push_back(result ? fmt::format("{:.3f}", result->seconds) : "");
      cells.push_back(run.name);
      text += csv_line(cells);
    }
    return text;
  }

 private:
  [[nodiscard]] static std::string cell(const RunResult& result, const std::string& header) {
    const auto value = result.final_values.find(header);
    if (value == result.final_values.end()) return "";
    const double number = std::strtod(value->second.c_str(), nullptr);
    // The sign of NaN is meaningless; other numbers have no more digits than needed to read the same number back.
    return std::isnan(number) ? "nan" : fmt::format("{}", number);
  }

  const SweepPaths& paths_;
  const SweepFile& sweep_;
  const std::vector<SweepRun>& runs_;
  std::vector<std::string> headers_;
};

}  // namespace

RunResult result_of(const RunPaths& paths, const nlohmann::json& summary) {
  RunResult result{summary.value("verdict", ""), summary.value("reason", "")};
  // The session has just written it or compared it with its checkpoint.
  const HistoryTable history(paths.history());
  if (history.n_rows() == 0) throw InputError(fmt::format("{}: holds no row", paths.history().string()));
  for (const std::string& name : history.names()) {
    result.final_values[history.header(name)] = fmt::format("{:.17g}", history.column(name).back());
  }
  return result;
}

void write_result(const std::filesystem::path& directory, const RunResult& result) {
  replace_shared_file(result_file(directory), json_text({{"verdict", result.verdict},
                                                         {"reason", result.reason},
                                                         {"seconds", result.seconds},
                                                         {"final", result.final_values}}));
}

std::optional<RunResult> read_result(const std::filesystem::path& directory) {
  try {
    const auto json = nlohmann::json::parse(text_of_file(result_file(directory)));
    return RunResult{json.at("verdict"), json.at("reason"), json.at("seconds"), json.at("final")};
  } catch (const nlohmann::json::exception&) {
    return std::nullopt;
  }
}

bool has_result(const std::filesystem::path& directory) { return ::access(result_file(directory).c_str(), F_OK) == 0; }

SweepCount write_sweep_table(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs) {
  const TableWriter writer(paths, sweep, runs);
  replace_shared_file(paths.description(), json_text(writer.description()));
  // Repeated until nothing changes, so that the last writer includes results that other workers added meanwhile.
  for (std::string written;;) {
    SweepCount count;
    const std::string text = writer.table(count);
    if (text == written) return count;
    replace_shared_file(paths.table(), text);
    written = text;
  }
}

}  // namespace vehd
