#include "bie/runs/sweep/sweep_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <csignal>
#include <cstring>
#include <set>

#include "bie/files/json_text.hpp"
#include "bie/runs/sweep/claim.hpp"
#include "bie/runs/sweep/run_result.hpp"
#include "bie/support/csv.hpp"

namespace vehd {
namespace {

/// A cell is one line, which any reader of tables understands.
std::string table_line(std::string text) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// A crash as a result. @return nullopt of a run that has none
std::optional<RunResult> crash_of(const std::filesystem::path& directory) {
  const ClaimState state = claim_state(directory);
  if (state.kind != ClaimState::Kind::crashed) return std::nullopt;
  const std::string reason =
      state.signal == SIGKILL
          ? fmt::format("{} workers in a row were killed at it", Claims::most_takeovers + 1)
          : fmt::format("ended its worker by signal {} ({})", state.signal, ::strsignal(state.signal));
  return RunResult{"crashed", reason, 0.0, {}, {}};
}

std::optional<RunResult> result_of_run(const SweepPaths& paths, const SweepRun& run) {
  if (!run.scene) return RunResult{"refused", run.refusal, 0.0, {}, {}};
  const std::filesystem::path directory = paths.runs() / run.name;
  if (auto result = read_result(directory)) return result;
  return crash_of(directory);
}

void count_result(const std::optional<RunResult>& result, SweepCount& count) {
  if (!result) {
    ++count.unfinished;
  } else if (result->verdict == "refused") {
    ++count.refused;
  } else if (result->verdict == "crashed") {
    ++count.crashed;
  } else if (!result->reason.empty()) {
    ++count.stopped;
  } else {
    ++count.completed;
  }
}

/// Cells of the columns that a table shows, all rows in the units of the base scene.
class ColumnCells {
 public:
  explicit ColumnCells(const SweepFile& sweep) : columns_(columns_of(sweep)) {
    const OutputUnits units(sweep.scene);
    for (const HistoryColumn& column : columns_) symbols_.push_back(units.of(column.dimension).symbol);
  }

  [[nodiscard]] std::vector<std::string> headers() const {
    std::vector<std::string> headers;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      headers.push_back(symbols_[i].empty() ? std::string(columns_[i].name)
                                            : fmt::format("{} [{}]", columns_[i].name, symbols_[i]));
    }
    return headers;
  }

  [[nodiscard]] std::vector<std::string> of(const SweepRun& run, const std::optional<RunResult>& result) const {
    std::vector<std::string> cells;
    for (std::size_t i = 0; i < columns_.size(); ++i) cells.push_back(result ? cell(run, *result, i) : "");
    return cells;
  }

 private:
  [[nodiscard]] std::string cell(const SweepRun& run, const RunResult& result, std::size_t i) const {
    const auto value = result.final_values.find(columns_[i].name);
    if (value == result.final_values.end()) return "";
    const auto found = result.units.find(columns_[i].name);
    const std::string unit = found == result.units.end() ? "" : found->second;
    double number = 0.0;
    const std::string& text = value->second;
    if (std::from_chars(text.data(), text.data() + text.size(), number).ec != std::errc()) return text;
    // The sign of what is no number means nothing.
    if (std::isnan(number)) return "nan";
    if (unit != symbols_[i] && run.scene) number *= factor(run, i, symbols_[i]) / factor(run, i, unit);
    // No more digits than give the same number back.
    return fmt::format("{}", number);
  }

  /// From a number of the scene to one in this unit.
  [[nodiscard]] double factor(const SweepRun& run, std::size_t i, const std::string& symbol) const {
    return OutputUnits(run.scene->units, {{std::string(columns_[i].dimension), symbol}})
        .of(columns_[i].dimension)
        .factor;
  }

  std::vector<HistoryColumn> columns_;
  std::vector<std::string> symbols_;
};

struct TableText {
  std::string text;
  SweepCount count;
};

TableText table_text(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs,
                     const ColumnCells& columns) {
  TableText table;
  std::vector<std::string> cells;
  for (const VariedKey& key : sweep.keys) cells.push_back(key.name);
  for (const std::string& header : columns.headers()) cells.push_back(header);
  for (const char* header : {"verdict", "reason", "seconds", "run"}) cells.emplace_back(header);
  table.text = csv_line(cells);
  std::set<std::string> counted;
  for (const SweepRun& run : runs) {
    const std::optional<RunResult> result = result_of_run(paths, run);
    count_result(result, table.count);
    cells.clear();
    for (const VariedValue& value : run.values) cells.push_back(value.shown);
    for (std::string& cell : columns.of(run, result)) cells.push_back(std::move(cell));
    cells.push_back(result ? table_line(result->verdict) : "unfinished");
    cells.push_back(result ? table_line(result->reason) : "");
    cells.push_back(result ? fmt::format("{:.3f}", result->seconds) : "");
    cells.push_back(run.name);
    table.text += csv_line(cells);
    // Rows of one scene share a run.
    if (result && counted.insert(run.name).second) table.count.seconds += result->seconds;
  }
  return table;
}

nlohmann::json description_of(const SweepFile& sweep, const ColumnCells& columns) {
  nlohmann::json json;
  json["scene"] = std::filesystem::absolute(sweep.scene_file).lexically_normal().string();
  json["mode"] = sweep.mode == SweepMode::zip ? "zip" : "grid";
  json["keys"] = nlohmann::json::array();
  for (const VariedKey& key : sweep.keys) {
    json["keys"].push_back({{"name", key.name}, {"scale", key.is_logarithmic ? "log" : "linear"}});
  }
  json["columns"] = columns.headers();
  json["runs"] = sweep.n_runs();
  return json;
}

}  // namespace

SweepCount write_sweep_table(const SweepPaths& paths, const SweepFile& sweep, const std::vector<SweepRun>& runs) {
  const ColumnCells columns(sweep);
  replace_shared_file(paths.description(), json_text(description_of(sweep, columns)));
  TableText table = table_text(paths, sweep, runs, columns);
  // Whoever writes last has seen all: what another worker has finished meanwhile is looked for once more.
  for (std::string written; table.text != written; table = table_text(paths, sweep, runs, columns)) {
    replace_shared_file(paths.table(), table.text);
    written = table.text;
  }
  return table.count;
}

}  // namespace vehd
