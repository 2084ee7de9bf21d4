#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "bie/bench/benches.hpp"
#include "bie/bench/pages.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/estimate/cost.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/reader.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

/// Extent of the benches, in full and as a trial.
struct Extent {
  std::vector<int> space, parts, symmetry;
  int threads_order;  ///< 0: that of the scene
  int time_order;     ///< degree for the comparison of integrators; 0: that of the scene
  int n_steps;        ///< step sizes
  std::vector<double> tolerances;
  int repeats;
};

Extent extent_of(bool quick) {
  if (quick) return {{6, 8}, {6, 8}, {6, 8}, 0, 0, 3, {1e-1, 1e-2, 1e-3}, 2};
  return {{8, 12, 16, 20, 24, 32},
          {8, 12, 16, 24, 32},
          {8, 12, 16, 24},
          24,
          24,
          5,
          {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7},
          9};
}

/// Step sizes, each half of the one before.
std::vector<double> steps_from(double first, int count) {
  std::vector<double> steps{first};
  while (static_cast<int>(steps.size()) < count) steps.push_back(0.5 * steps.back());
  return steps;
}

/// One row for each scene: its largest error over the tolerance, and the steps, degree and seconds for every second
/// tolerance. The last tolerance is the reference.
/// @param rows  of all scenes, one for each tolerance
BenchTable scenes_table(const BenchTable& rows, std::size_t n_tolerances) {
  BenchTable table{"scenes",
                   {{"scene", "scene", "{}", false, 24},
                    {"time", "t", "{:g}"},
                    {"error_over_tolerance", "error/tolerance at most", "{:.2f}"}}};
  const std::vector<BenchColumn> repeated = {
      {"steps", "steps"}, {"order", "degree"}, {"seconds", "seconds", "{:.2g}", true}};
  for (const BenchColumn& column : repeated) {
    for (std::size_t i = 0; i + 1 < n_tolerances; i += 2) {
      const std::string tolerance = fmt::format("{:.0e}", std::get<double>(cell_of(rows, i, "tolerance")));
      table.columns.push_back(
          {column.key + "_" + tolerance, column.heading + ", " + tolerance, column.format, column.timing});
    }
  }
  for (std::size_t first = 0; first < rows.rows.size(); first += n_tolerances) {
    double error = 0.0;
    for (std::size_t i = first; i + 1 < first + n_tolerances; ++i) {
      error = std::max(error, std::get<double>(cell_of(rows, i, "error_over_tolerance")));
    }
    std::vector<BenchCell> row{cell_of(rows, first, "scene"), cell_of(rows, first, "time"), error};
    for (const BenchColumn& column : repeated) {
      for (std::size_t i = 0; i + 1 < n_tolerances; i += 2) row.push_back(cell_of(rows, first + i, column.key));
    }
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Runs all benches one after the other and renews the pages.
class AllBenches {
 public:
  AllBenches(const AllTask& task, BenchObserver& observer)
      : task_(task), observer_(observer), extent_(extent_of(task.quick)) {
    scenes_ = scene_files(task.docs / "scenes");
    make_directory(task.output.directory);
    make_directory(task.docs / "images");
    wanted_ = tables_in_pages(task.docs);
  }

  nlohmann::ordered_json run() {
    for (const Bench& bench : kBenches) {
      if (task_.only.empty() || std::ranges::find(task_.only, bench.name) != task_.only.end()) (this->*bench.run)();
    }
    report();
    return record_;
  }

  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const Bench& bench : kBenches) names.emplace_back(bench.name);
    return names;
  }

 private:
  [[nodiscard]] Scene scene(const std::string& name) const {
    return read_scene(task_.docs / "scenes" / (name + ".toml"));
  }

  void keep(const BenchResult& result) {
    record_[result.name] = write_bench(result, task_.output, observer_);
    for (std::size_t i = 0; i < result.tables.size(); ++i) {
      const std::string name = name_of_table(result, i);
      const std::string text = fmt::format(
          "{}\n*{}{}; {}.*\n", markdown_of(result.tables[i]), text_of(result.machine),
          task_.quick ? "; a trial, not for comparison" : "",
          result.repeats == 1 ? "one run each" : fmt::format("medians of up to {} repeats", result.repeats));
      if (put_table(task_.docs, name, text) > 0) wanted_.erase(name);
      if (task_.output.plot) copy_if_shown(task_.output.directory / (name + ".png"), "bench_" + name + ".png");
    }
  }

  /// Replaces a picture of the pages, if any page shows it.
  void copy_if_shown(const fs::path& picture, const std::string& name) {
    if (!pages_mention(task_.docs, "images/" + name)) return;
    std::error_code error;
    fs::copy_file(picture, task_.docs / "images" / name, fs::copy_options::overwrite_existing, error);
    if (error) observer_.warn(fmt::format("no new picture {}: {}", name, error.message()));
  }

  void scenes() {
    observer_.section("every scene");
    const fs::path pictures = task_.output.directory / "scenes";
    make_directory(pictures);
    keep(bench_scenes(scenes_, pictures, observer_));
    for (const auto& picture : fs::directory_iterator(pictures)) {
      copy_if_shown(picture.path(), picture.path().filename().string());
    }
  }

  void space() {
    observer_.section("space");
    keep(bench_space(extent_.space, extent_.repeats, observer_));
  }

  /// Example 2 on its way through the tube-like phase.
  void time() {
    const Scene figure2 = scene("figure2");
    const double at = figure2.numerics.end_time / 4;
    const std::vector<double> steps = steps_from(*figure2.numerics.dt, extent_.n_steps);
    observer_.section("time: figure2.toml, the paper's scheme");
    BenchResult result = bench_time({.scene = figure2, .at = at, .steps = steps}, observer_);
    result.name = "time_figure2_quarter";
    keep(result);
    observer_.section("time: figure2.toml, integrators and tolerance");
    Scene resolved = figure2;
    if (extent_.time_order > 0) resolved.numerics.order = extent_.time_order;
    keep(bench_time(
        {.scene = resolved, .at = at, .steps = steps, .time_orders = {1, 2, 4}, .tolerances = extent_.tolerances},
        observer_));
  }

  void tolerances() {
    BenchResult all{"tolerances",
                    machine_record(),
                    1,
                    {{"reference", "the run with the last tolerance of the scene"},
                     {"predicted", "of the cost table, seconds without files, which these runs do not write"}},
                    {{"rows",
                      {{"scene", "scene", "{}", false, 24},
                       {"time", "t", "{:g}"},
                       {"tolerance", "tolerance", "{:.0e}"},
                       {"steps", "steps"},
                       {"predicted_steps", "predicted steps"},
                       {"order", "highest degree"},
                       {"error_over_tolerance", "error/tolerance", "{:.2f}"},
                       {"seconds", "seconds", "{:.2g}", true},
                       {"predicted", "predicted seconds", "{:.2g}"}}}}};
    for (const fs::path& file : scenes_) {
      observer_.section("tolerances: " + file.filename().string());
      const Scene asked = read_scene(file);
      std::vector<CostRow> costs;  // none in a trial
      if (!task_.quick) costs = cost_table_of(asked, extent_.tolerances);
      const BenchResult one = bench_time({.scene = asked,
                                          .at = asked.numerics.end_time,
                                          .tolerances = extent_.tolerances,
                                          .snapshots = events_of(asked).snapshots},
                                         observer_);
      const BenchTable& rows = one.tables.front();
      const auto cell = [&](std::size_t row, const std::string& key) { return cell_of(rows, row, key); };
      for (std::size_t row = 0; row < rows.rows.size(); ++row) {
        const auto predicted = [&](auto of_row) { return costs.empty() ? BenchCell() : BenchCell(of_row(costs[row])); };
        all.tables.front().rows.push_back(
            {file.filename().string(), asked.numerics.end_time, cell(row, "tolerance"), cell(row, "steps"),
             predicted([](const CostRow& cost) { return cost.steps; }), cell(row, "order"),
             cell(row, "error_over_tolerance"), cell(row, "seconds"),
             predicted([](const CostRow& cost) { return cost.seconds - cost.file_seconds; })});
      }
    }
    all.tables.push_back(scenes_table(all.tables.front(), extent_.tolerances.size()));
    keep(all);
  }

  void parts() {
    observer_.section("parts: figure5_no_field.toml");
    keep(bench_parts(scene("figure5_no_field"), extent_.parts, extent_.repeats, observer_));
  }

  void threads() {
    observer_.section("threads: figure5_no_field.toml");
    Scene sheared = scene("figure5_no_field");
    if (extent_.threads_order > 0) sheared.numerics.order = extent_.threads_order;
    keep(bench_threads(sheared, thread_counts(), extent_.repeats, observer_));
  }

  void symmetry() {
    observer_.section("symmetry: figure2.toml");
    keep(bench_symmetry(scene("figure2"), extent_.symmetry, extent_.repeats, observer_));
  }

  void methods() {
    observer_.section("methods");
    if (!fem_program_is_built()) {
      without_.emplace_back("methods (the finite elements are not built: cmake -DSTEP=check -P bie/setup.cmake)");
      observer_.note("left out: the finite elements are not built");
      return;
    }
    keep(bench_methods({task_.quick, task_.quick ? 1 : 3}, task_.output.directory, observer_));
  }

  void stability() {
    const fs::path scenes = task_.docs.parent_path() / "tests/hard/scenes";
    if (!fs::is_directory(scenes)) {
      without_.emplace_back("stability (no scenes in " + scenes.string() + ")");
      return;
    }
    observer_.section("stability");
    const BenchOutput output{task_.output.directory / "stability", task_.output.plot};
    Interruption interruption;
    keep(bench_stability({scene_files(scenes), output, task_.quick}, interruption, observer_).result);
    if (!task_.output.plot) return;
    make_directory(task_.docs / "images/hard_cases");
    fs::copy(output.directory / "shapes", task_.docs / "images/hard_cases",
             fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }

  /// Whole runs: a trial leaves them out.
  void pages() {
    if (task_.quick || !task_.output.plot) return;
    observer_.section("pictures that pages make by their own commands");
    for (const std::string& page : renew_pictures_of_pages(task_.docs, observer_)) {
      without_.push_back("pictures of " + page);
    }
  }

  void report() const {
    std::string text = fmt::format("\npages and pictures in {} are renewed", task_.docs.string());
    if (!without_.empty()) text += fmt::format(", without {}", fmt::join(without_, ", "));
    if (!wanted_.empty()) text += fmt::format("; tables left as they were: {}", fmt::join(wanted_, ", "));
    observer_.note(text);
  }

  struct Bench {
    const char* name;
    void (AllBenches::*run)();
  };
  static const std::array<Bench, 10> kBenches;

  const AllTask& task_;
  BenchObserver& observer_;
  Extent extent_;
  std::vector<fs::path> scenes_;
  std::set<std::string> wanted_;
  std::vector<std::string> without_;
  nlohmann::ordered_json record_;
};

const std::array<AllBenches::Bench, 10> AllBenches::kBenches = {{{"scenes", &AllBenches::scenes},
                                                                 {"space", &AllBenches::space},
                                                                 {"time", &AllBenches::time},
                                                                 {"tolerances", &AllBenches::tolerances},
                                                                 {"parts", &AllBenches::parts},
                                                                 {"threads", &AllBenches::threads},
                                                                 {"symmetry", &AllBenches::symmetry},
                                                                 {"methods", &AllBenches::methods},
                                                                 {"stability", &AllBenches::stability},
                                                                 {"pages", &AllBenches::pages}}};

}  // namespace

std::vector<std::string> names_of_benches() { return AllBenches::names(); }

nlohmann::ordered_json bench_all(const AllTask& task, BenchObserver& observer) {
  return AllBenches(task, observer).run();
}

}  // namespace vehd
