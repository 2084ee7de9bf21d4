#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/bench/benches.hpp"
#include "bie/bench/result.hpp"
#include "bie/scene/given_time.hpp"
#include "bie/scene/reader.hpp"
#include "bie/scene/scene.hpp"
#include "bie/scene/vesicles.hpp"
#include "bie/sphere/degrees.hpp"
#include "bie/stepping/time/time_rule.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Prints results of benches on standard output, progress on standard error.
class BenchPrinter : public BenchObserver {
 public:
  void section(const std::string& title) override { print("\n== " + title + "\n"); }
  void note(const std::string& line) override { print(line + "\n"); }
  void warn(const std::string& problem) override {
    progress_.clear();
    spdlog::warn("{}", problem);
  }
  void heading(const BenchTable& table) override { print(heading_line(table)); }
  void row(const BenchTable& table, const std::vector<BenchCell>& row) override { print(row_line(table, row)); }
  void task(int number, int n_tasks, const std::string& what) override {
    progress_.begin(static_cast<double>(number - 1) / n_tasks, fmt::format("[{}/{}] {}", number, n_tasks, what));
  }
  void status(const RunStatus& status) override { show_run(progress_, status); }

 private:
  void print(const std::string& text) {
    progress_.clear();
    fmt::print("{}", text);
    std::fflush(stdout);
  }

  Progress progress_{Progress::suitable_style()};
};

/// Options of every bench.
struct BenchOptions {
  std::string directory = "out/bench";
  bool no_plot = false;
  int repeats = 5;
  CommonOptions common;

  [[nodiscard]] BenchOutput output() const { return {directory, !no_plot}; }
};

struct SceneOptions {
  SceneSource scene;
  std::vector<int> orders, threads, time_orders;
  std::vector<std::string> steps;
  std::vector<double> tolerances;
  int order = 0, time_order = 0;
  std::string at;
  bool quick = false;
  std::string docs = "docs";
  std::vector<std::string> only;
  BenchOptions bench;
};

Scene scene_of_one(const SceneSource& source) {
  Scene scene = read_scene(source);
  require_one_vesicle(scene, source.file, "vehd bench");
  return scene;
}

void add_output_options(CLI::App& command, BenchOptions& options) {
  command.add_option("-o,--output", options.directory, "Directory for tables and pictures; created if missing")
      ->type_name("DIR")
      ->capture_default_str();
  command.add_flag("--no-plot", options.no_plot, "Draw no picture");
  add_common_options(command, options.common);
}

CLI::Option* add_repeats(CLI::App& command, BenchOptions& options, int repeats) {
  options.repeats = repeats;
  return command
      .add_option("--repeats", options.repeats,
                  "Repetitions of each timing, fewer of long ones; the median is reported")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
}

void add_orders(CLI::App& command, SceneOptions& options, std::vector<int> orders) {
  options.orders = std::move(orders);
  command.add_option("--degrees,--orders", options.orders, "Degrees p, ascending")
      ->delimiter(',')
      ->check(CLI::Range(lowest_order, highest_order))
      ->capture_default_str();
}

/// Adds `vehd bench NAME`; `measure` returns its result.
template <typename Measure>
void add_bench(CLI::App& command, const std::shared_ptr<SceneOptions>& options, ExitCode& exit_code,
               const Measure& measure) {
  add_output_options(command, options->bench);
  // The bench of threads takes several numbers of threads.
  if (command.get_option_no_throw("--threads") == nullptr) add_threads_option(command);
  command.callback([options, &exit_code, measure] {
    BenchPrinter printer;
    // Before anything is measured, so that a directory that cannot be written is reported at once.
    make_directory(options->bench.directory);
    BenchResult result = measure(*options, printer);
    if (!options->scene.file.empty()) result.facts["scene"] = text_of(options->scene);
    write_json(options->bench.common, write_bench(result, options->bench.output(), printer));
    exit_code = ExitCode::done;
  });
}

void add_space(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command = bench.add_subcommand("space", "Errors of q, f_E and velocity against the degree and the seconds");
  const auto options = std::make_shared<SceneOptions>();
  add_orders(*command, *options, {8, 12, 16, 20, 24, 32});
  add_repeats(*command, options->bench, 5);
  add_bench(*command, options, exit_code, [](const SceneOptions& o, BenchObserver& observer) {
    return bench_space(o.orders, o.bench.repeats, observer);
  });
}

/// The time as a number of the scene; a text without a unit is one already.
double positive_time(const char* option, const std::string& text, const Scene& scene) {
  const double time = number_of_time(text, scene.units, OutputUnit{});
  if (time > 0.0) return time;
  throw InputError(fmt::format("{}: {} is not above 0", option, text));
}

void add_time(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command =
      bench.add_subcommand("time", "Errors against step size, steps and seconds, and against the tolerance");
  const auto options = std::make_shared<SceneOptions>();
  add_scene_choice(*command, options->scene);
  auto* choice = command->add_option_group("varied quantity");
  choice
      ->add_option("--dt", options->steps,
                   "Step sizes as \"0.5 ms\" or numbers of the scene, each half of the one before")
      ->type_name("T,T,...")
      ->delimiter(',')
      ->check(time_text());
  choice->add_option("--tolerance", options->tolerances, "Tolerances, falling; the last is the reference")
      ->delimiter(',')
      ->check(number_in(1e-9, 0.1));
  choice->require_option(1, 2);
  command->add_option("--time-orders", options->time_orders, "Integrators for --dt; that of the scene if not given")
      ->delimiter(',')
      ->check(CLI::Range(1, highest_time_order));
  command->add_option("--degree,--order", options->order, "Degree p for --dt; that of the scene if not given")
      ->check(CLI::Range(4, 64));
  command->add_option("--at", options->at, "Time at which the values are taken, as \"5 ms\" or a number of the scene")
      ->type_name("T")
      ->required()
      ->check(time_text());
  add_repeats(*command, options->bench, 1);
  add_bench(*command, options, exit_code, [](const SceneOptions& o, BenchObserver& observer) {
    Scene scene = read_scene(o.scene);
    if (o.order > 0) scene.numerics.order = o.order;
    std::vector<double> steps;
    for (const std::string& step : o.steps) steps.push_back(positive_time("--dt", step, scene));
    return bench_time({.scene = scene,
                       .at = positive_time("--at", o.at, scene),
                       .steps = steps,
                       .time_orders = o.time_orders,
                       .tolerances = o.tolerances,
                       .repeats = o.bench.repeats},
                      observer);
  });
}

/// A bench of single steps of a scene against the degree.
struct StepBench {
  const char* name;
  const char* description;
  std::vector<int> orders;
  int repeats;
  BenchResult (*measure)(Scene scene, const std::vector<int>& orders, int repeats, BenchObserver& observer);
};

void add_step_bench(CLI::App& bench, ExitCode& exit_code, const StepBench& what) {
  CLI::App* command = bench.add_subcommand(what.name, what.description);
  const auto options = std::make_shared<SceneOptions>();
  add_scene_choice(*command, options->scene);
  add_orders(*command, *options, what.orders);
  add_repeats(*command, options->bench, what.repeats);
  add_bench(*command, options, exit_code, [measure = what.measure](const SceneOptions& o, BenchObserver& observer) {
    return measure(scene_of_one(o.scene), o.orders, o.bench.repeats, observer);
  });
}

void add_threads(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command = bench.add_subcommand("threads", "Seconds of each part of a step against the number of threads");
  const auto options = std::make_shared<SceneOptions>();
  add_scene_choice(*command, options->scene);
  options->threads = thread_counts();
  command->add_option("--threads", options->threads, "Numbers of threads; speed-up is over the first")
      ->delimiter(',')
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--degree,--order", options->order, "Degree p; that of the scene if not given")
      ->check(CLI::Range(4, 64));
  command->add_option("--time-order", options->time_order, "Integrator; that of the scene if not given")
      ->check(CLI::Range(1, highest_time_order));
  add_repeats(*command, options->bench, 5);
  add_bench(*command, options, exit_code, [](const SceneOptions& o, BenchObserver& observer) {
    Scene scene = read_scene(o.scene);
    if (o.order > 0) scene.numerics.order = o.order;
    if (o.time_order > 0) scene.numerics.time_order = o.time_order;
    return bench_threads(scene, o.threads, o.bench.repeats, observer);
  });
}

void add_methods(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command =
      bench.add_subcommand("methods", "Boundary integrals against finite elements on an exact solution");
  const auto options = std::make_shared<SceneOptions>();
  command->add_flag("--quick", options->quick, "Two levels of each, one repeat");
  const CLI::Option* repeats = add_repeats(*command, options->bench, 3);
  command->footer("Needs the finite-element program (VEHD_FEM_CHECK). See docs/two_methods.md.");
  add_bench(*command, options, exit_code, [repeats](const SceneOptions& o, BenchObserver& observer) {
    return bench_methods({o.quick, o.quick && repeats->count() == 0 ? 1 : o.bench.repeats}, o.bench.directory,
                         observer);
  });
}

void add_all(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command =
      bench.add_subcommand("all", "Run every scene and every bench, and renew the tables and pictures of the pages");
  const auto options = std::make_shared<SceneOptions>();
  command->add_option("--docs", options->docs, "Folder of the pages, with scenes/")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "A small part of each, as a test");
  command->add_option("--only", options->only, "Only these benches")
      ->delimiter(',')
      ->check(CLI::IsMember(names_of_benches()));
  add_output_options(*command, options->bench);
  add_threads_option(*command);
  command->callback([options, &exit_code] {
    BenchPrinter printer;
    write_json(options->bench.common,
               bench_all({options->docs, options->bench.output(), options->quick, options->only}, printer));
    exit_code = ExitCode::done;
  });
}

void add_stability(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command = bench.add_subcommand("stability", "Hard cases, each against its criterion");
  struct StabilityOptions {
    std::string scenes = "tests/hard/scenes";
    bool quick = false;
    BenchOptions bench;
  };
  const auto options = std::make_shared<StabilityOptions>();
  command->add_option("SCENES", options->scenes, "Folder of scenes with criteria, or one of them")
      ->check(CLI::ExistingPath)
      ->capture_default_str();
  command->add_flag("--quick", options->quick, "The short form of every case");
  add_output_options(*command, options->bench);
  add_threads_option(*command);
  command->footer("Exit code 4 if a criterion fails. See docs/hard_cases.md.");
  command->callback([options, &exit_code] {
    Interruption interruption;
    BenchPrinter printer;
    make_directory(options->bench.directory);
    const StabilityOutcome outcome =
        bench_stability({scene_files(options->scenes), options->bench.output(), options->quick}, interruption, printer);
    write_json(options->bench.common, write_bench(outcome.result, options->bench.output(), printer));
    exit_code = outcome.n_failed == 0 ? ExitCode::done : ExitCode::check_failed;
  });
}

void add_redraw(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command = bench.add_subcommand("redraw", "Draw the pictures again from the tables of earlier benches");
  struct RedrawOptions {
    std::string directory = "out/bench", docs;
    CommonOptions common;
  };
  const auto options = std::make_shared<RedrawOptions>();
  command->add_option("DIR", options->directory, "Folder of their tables (NAME.csv); pictures lie beside them")
      ->check(CLI::ExistingDirectory)
      ->capture_default_str();
  command->add_option("--docs", options->docs, "Folder of pages whose pictures are renewed as well")
      ->type_name("DIR")
      ->check(CLI::ExistingDirectory);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    nlohmann::json result;
    for (const auto& picture : redraw(options->directory, options->docs)) {
      fmt::print("{}\n", picture.string());
      result["pictures"].push_back(picture.string());
    }
    write_json(options->common, result);
    exit_code = ExitCode::done;
  });
}

}  // namespace

void add_bench_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command =
      program.add_subcommand("bench", "Measure the cost of accuracy: tables and pictures of error and seconds");
  command->require_subcommand(1);
  add_space(*command, exit_code);
  add_time(*command, exit_code);
  add_step_bench(
      *command, exit_code,
      {"parts", "Seconds and memory of each part of a step against the degree", {8, 12, 16, 24, 32}, 5, bench_parts});
  add_threads(*command, exit_code);
  add_step_bench(
      *command, exit_code,
      {"symmetry", "Seconds of a step with the symmetry of the scene and without", {8, 12, 16, 24}, 9, bench_symmetry});
  add_methods(*command, exit_code);
  add_stability(*command, exit_code);
  add_all(*command, exit_code);
  add_redraw(*command, exit_code);
}

}  // namespace vehd
