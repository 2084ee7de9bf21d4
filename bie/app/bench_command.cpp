#include <fmt/format.h>

#include <memory>

#include "bie/app/bench_methods.hpp"
#include "bie/app/bench_parts.hpp"
#include "bie/app/bench_time.hpp"
#include "bie/app/commands.hpp"
#include "bie/scene/reader.hpp"

namespace vehd {
namespace {

struct PartsOptions {
  std::string scene_file;
  std::vector<int> orders{8, 12, 16, 24, 32};
  int repeats = 5;
  CommonOptions common;
};

struct TimeOptions {
  std::string scene_file;
  std::vector<double> steps, tolerances;
  double at = 0.0;
  CommonOptions common;
};

struct MethodsOptions {
  MethodsTask task{"out/bench_methods"};
  bool no_plot = false;
  CommonOptions common;
};

void add_parts(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command = bench.add_subcommand("parts", "Seconds and memory of each part of a step against the order");
  const auto options = std::make_shared<PartsOptions>();
  command->add_option("SCENE", options->scene_file, "Scene file (TOML)")->required();
  command->add_option("--orders", options->orders, "Orders, ascending")
      ->delimiter(',')
      ->check(CLI::Range(4, 64))
      ->capture_default_str();
  command->add_option("--repeats", options->repeats, "Timed steps; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    write_json(options->common, bench_parts(read_scene(options->scene_file), options->orders, options->repeats));
    exit_code = ExitCode::done;
  });
}

void add_time(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command =
      bench.add_subcommand("time", "Values or errors and seconds against the step size or the tolerance");
  const auto options = std::make_shared<TimeOptions>();
  command->add_option("SCENE", options->scene_file, "Scene file (TOML)")->required();
  auto* choice = command->add_option_group("what varies");
  choice->add_option("--dt", options->steps, "Step sizes, each half of the one before")
      ->delimiter(',')
      ->check(CLI::PositiveNumber);
  choice->add_option("--tolerance", options->tolerances, "Tolerances, falling; the last is the reference")
      ->delimiter(',')
      ->check(CLI::Range(1e-9, 0.1));
  choice->require_option(1);
  command->add_option("--at", options->at, "Time at which the values are taken")
      ->required()
      ->check(CLI::PositiveNumber);
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] {
    const Scene scene = read_scene(options->scene_file);
    write_json(options->common, options->steps.empty() ? bench_tolerance(scene, options->tolerances, options->at)
                                                       : bench_time(scene, options->steps, options->at));
    exit_code = ExitCode::done;
  });
}

void add_methods(CLI::App& bench, ExitCode& exit_code) {
  CLI::App* command =
      bench.add_subcommand("methods", "Boundary integrals against finite elements on an exact solution");
  const auto options = std::make_shared<MethodsOptions>();
  MethodsTask& task = options->task;
  command->add_option("-o,--output", task.directory, "Directory for table and picture")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--quick", task.quick, "Two levels of each, one repeat");
  command->add_option("--repeats", task.repeats, "Timed solves of each level, fewer of long ones; the median counts")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag("--no-plot", options->no_plot, "Draw no picture");
  add_common_options(*command, options->common);
  command->footer("Needs the finite-element program (VEHD_FEM_CHECK). See docs/two_methods.md.");
  command->callback([options, &exit_code, repeats = command->get_option("--repeats")] {
    MethodsTask methods = options->task;
    methods.plot = !options->no_plot;
    if (methods.quick && repeats->count() == 0) methods.repeats = 1;
    write_json(options->common, bench_methods(methods));
    exit_code = ExitCode::done;
  });
}

}  // namespace

void add_bench_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("bench", "What accuracy costs: tables of error and seconds");
  command->require_subcommand(1);
  add_parts(*command, exit_code);
  add_time(*command, exit_code);
  add_methods(*command, exit_code);
}

}  // namespace vehd
