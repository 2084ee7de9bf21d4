#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bie/bench/benches.hpp"
#include "bie/bench/stability_case.hpp"
#include "bie/files/run_reader.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/shape_field.hpp"
#include "bie/runs/run_loop.hpp"
#include "bie/runs/verdict.hpp"
#include "bie/scene/effective_scene.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// One criterion, measured.
struct Finding {
  std::string what;
  double value = 0.0;
  double bound = 0.0;

  [[nodiscard]] bool holds() const { return value <= bound; }
  /// Value over bound, to compare findings.
  [[nodiscard]] double share() const { return std::isnan(value) ? INFINITY : value / bound; }
};

/// The largest rise between successive rows, relative to the value.
double largest_rise(const std::vector<double>& values) {
  double rise = 0.0;
  for (std::size_t i = 1; i < values.size(); ++i) {
    rise = std::max(rise, (values[i] - values[i - 1]) / std::abs(values[i - 1]));
  }
  return rise;
}

/// Maximum minus minimum in the second half, relative to the last value.
double late_change(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin() + static_cast<Index>(values.size() / 2), values.end());
  return (*most - *least) / std::abs(values.back());
}

std::vector<Finding> findings_of(const StabilityCase& hard, const HistoryTable& history, bool brief) {
  // Error of an energy due to the solvers and to constraints that hold to 1e-9.
  constexpr double rounding_of_energy = 1e-8;
  std::vector<Finding> findings;
  for (const ColumnBound& bound : hard.most) {
    findings.push_back({bound.column, history.largest_magnitude(bound.column), bound.bound});
  }
  for (const std::string& column : hard.falls) {
    findings.push_back({column + " rises", largest_rise(history.column(column)), rounding_of_energy});
  }
  // A short run has not settled.
  if (!brief) {
    for (const ColumnBound& bound : hard.steady) {
      findings.push_back({bound.column + " moves", late_change(history.column(bound.column)), bound.bound});
    }
  }
  return findings;
}

std::string end_problem(ExpectedEnd expected, const RunOutcome& outcome, const std::string& verdict) {
  switch (expected) {
    case ExpectedEnd::completed:
      if (!outcome.completed) return outcome.reason;
      return verdict == trustworthy ? "" : verdict;
    case ExpectedEnd::flagged:
      if (!outcome.completed) return outcome.reason;
      return verdict == trustworthy ? "is not flagged" : "";
    case ExpectedEnd::stops:
      return outcome.completed ? "goes on to its end" : "";
  }
  return "";
}

std::string end_text(const StabilityCase& hard, const RunOutcome& outcome, const std::string& verdict) {
  if (!outcome.completed) return verdict;
  return hard.expect == ExpectedEnd::flagged ? "flagged: " + verdict : "";
}

BenchTable empty_stability_table() {
  return {"rows",
          {{"case", "case", "{}", false, 26},
           {"family", ""},
           {"criterion", "nearest criterion", "{}", false, 28},
           {"worst", "worst", "{:.2g}"},
           {"bound", "bound", "{:.2g}"},
           {"steps", "steps"},
           {"rejected", "rejected"},
           {"iterations_flow", "flow it.", "{:.0f}"},
           {"iterations_electric", "el. it.", "{:.0f}"},
           {"seconds", "seconds", "{:.2f}"},
           {"verdict", "verdict", "{}", false, 8}}};
}

std::vector<BenchCell> row_of(const StabilityCase& hard, const RunTask& run, const RunOutcome& outcome, bool brief,
                              bool& failed) {
  const HistoryTable history(run.paths.history());
  const std::string verdict = verdict_of(history, trust_demands(hard.scene), outcome.reason);
  const std::vector<Finding> findings = findings_of(hard, history, brief);
  const Finding worst = *std::max_element(findings.begin(), findings.end(),
                                          [](const Finding& a, const Finding& b) { return a.share() < b.share(); });
  std::string problem = end_problem(hard.expect, outcome, verdict);
  if (problem.empty() && !worst.holds()) problem = fmt::format("{} beyond its bound", worst.what);
  failed = !problem.empty();
  const auto& rejected = history.column("rejected");
  const std::string end = end_text(hard, outcome, verdict);
  return {hard.name,
          hard.family,
          worst.what,
          worst.value,
          worst.bound,
          history.n_steps(),
          static_cast<std::int64_t>(std::accumulate(rejected.begin(), rejected.end(), 0.0)),
          history.largest_magnitude("iterations_flow"),
          history.largest_magnitude("iterations_electric"),
          read_checkpoint(run.paths.checkpoint()).totals.seconds,
          failed ? "FAILS: " + problem : "holds" + (end.empty() ? "" : ", " + end)};
}

/// One row for each family: the criterion that is closest to its bound in all its cases.
/// @param rows  of all cases, ordered by family
BenchTable families_table(const BenchTable& rows) {
  BenchTable table{"families",
                   {{"family", "family", "{}"},
                    {"cases", "cases"},
                    {"criterion", "nearest criterion", "{}"},
                    {"case", "case", "{}"},
                    {"worst", "value", "{:.2g}"},
                    {"bound", "bound", "{:.2g}"}}};
  const auto family = [&](std::size_t row) { return std::get<std::string>(cell_of(rows, row, "family")); };
  const auto share = [&](std::size_t row) {
    const auto number = [&](const char* key) { return std::get<double>(cell_of(rows, row, key)); };
    return Finding{"", number("worst"), number("bound")}.share();
  };
  for (std::size_t first = 0; first < rows.rows.size();) {
    std::size_t worst = first, end = first;
    for (; end < rows.rows.size() && family(end) == family(first); ++end) {
      if (share(end) > share(worst)) worst = end;
    }
    table.rows.push_back({cell_of(rows, first, "family"), static_cast<std::int64_t>(end - first),
                          cell_of(rows, worst, "criterion"), cell_of(rows, worst, "case"),
                          cell_of(rows, worst, "worst"), cell_of(rows, worst, "bound")});
    first = end;
  }
  return table;
}

/// The cases that fail, or that do not end with a trustworthy run.
BenchTable faults_table(const BenchTable& rows) {
  BenchTable table{"faults", {{"case", "case", "{}"}, {"verdict", "verdict", "{}"}}};
  for (std::size_t row = 0; row < rows.rows.size(); ++row) {
    const std::string verdict = std::get<std::string>(cell_of(rows, row, "verdict"));
    if (verdict != "holds") table.rows.push_back({cell_of(rows, row, "case"), verdict});
  }
  return table;
}

/// Has the last shape a hollow, which no view from outside shows: H > 0 on more than a hundredth of its area?
bool has_hollow(const RunPaths& paths) {
  constexpr int grid_degree = 24;
  constexpr double least_share = 0.01;
  const RunReader run(paths.snapshots());
  const ShapeField& curvature = shape_field("curvature");
  const auto read = read_shape(run.snapshot(run.times().size() - 1), curvature);
  const Shape shape = shape_of(read, curvature, grid_degree);
  return shape.weights.dot((shape.values.array() > 0.0).cast<double>().matrix()) > least_share * shape.weights.sum();
}

}  // namespace

std::filesystem::path draw_case(const RunPaths& paths, const std::filesystem::path& folder) {
  make_directory(folder);
  constexpr double width = 300.0;
  const std::filesystem::path picture = folder / (paths.directory.filename().string() + ".png");
  plot_shapes({paths, {}, folder, PictureFormat::png, {.section = has_hollow(paths), .width = width}}, {picture});
  return picture;
}

StabilityOutcome bench_stability(const StabilityTask& task, Interruption& interruption, BenchObserver& observer) {
  std::vector<StabilityCase> cases;
  for (const std::filesystem::path& path : task.scenes) {
    cases.push_back(read_stability_case(path));
    Scene& scene = cases.back().scene;
    // Bounds are in units of the scene.
    scene.output.units = ResultUnits::dimensionless;
    if (task.brief) scene.numerics.end_time = std::min(scene.numerics.end_time, cases.back().short_end_time);
  }
  std::stable_sort(cases.begin(), cases.end(),
                   [](const StabilityCase& a, const StabilityCase& b) { return a.family < b.family; });
  StabilityOutcome outcome{
      {"stability",
       machine_record(),
       1,
       {{"brief", task.brief}},
       {empty_stability_table(), {"pictures", {{"case", "case", "{}"}, {"shapes", "first and last shape", "{}"}}}}}};
  BenchTable& table = outcome.result.tables.front();
  BenchTasks tasks(static_cast<int>(cases.size()), observer);
  observer.heading(table);
  for (const StabilityCase& hard : cases) {
    tasks.next(hard.name);
    const RunPaths paths{task.output.directory / "runs" / hard.name};
    std::filesystem::remove_all(paths.directory);
    make_directory(paths.directory);
    const std::optional<Checkpoint> none;
    const RunTask run{hard.scene, paths, none};
    const RunOutcome end = simulate(run, interruption);
    if (interruption.requested()) {
      throw Interrupted(
          fmt::format("stopped by a signal after {} of {} cases; there is no table", table.rows.size(), cases.size()));
    }
    bool failed = false;
    const std::vector<BenchCell> row = row_of(hard, run, end, task.brief, failed);
    add_row(table, row, observer);
    outcome.n_failed += failed ? 1 : 0;
    if (task.output.plot) {
      draw_case(paths, task.output.directory / "shapes");
      outcome.result.tables[1].rows.push_back({hard.name, fmt::format("![{0}](images/hard_cases/{0}.png)", hard.name)});
    }
  }
  outcome.result.tables.push_back(families_table(outcome.result.tables.front()));
  outcome.result.tables.push_back(faults_table(outcome.result.tables.front()));
  outcome.result.facts["failed"] = outcome.n_failed;
  return outcome;
}

}  // namespace vehd
