#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <utility>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/comparison/check.hpp"
#include "bie/comparison/frozen_state.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

struct CheckOptions {
  SceneSource scene;  ///< or a run.h5
  std::optional<std::string> time, from;
  std::string directory;
  bool quick = false;
  std::optional<double> required;
  bool no_plot = false;
  std::optional<int> ranks;
  CommonOptions common;
};

std::filesystem::path directory_of(const CheckOptions& options) {
  if (!options.directory.empty()) return options.directory;
  const std::filesystem::path& file = options.scene.file;
  if (file.extension() == ".toml") return default_directory(file) += "_check";
  return file.parent_path() / "check";
}

/// A missing picture must not spoil a finished comparison.
void draw_if_possible(const std::filesystem::path& directory) {
  try {
    if (draw_differences(directory)) fmt::print("picture: {}\n", (directory / "differences.png").string());
  } catch (const std::exception& error) {
    spdlog::warn("no picture: {}", error.what());
  }
}

/// Called once for each of the two degrees.
void print_solved(const CheckFields& fields, bool first) {
  fmt::print(stderr, "{}degree {} in {:.1f} s{}", first ? "boundary integrals: " : ", ", fields.order, fields.seconds,
             first ? "" : "\n");
}

ExitCode check(const CheckOptions& options) {
  const FemProgram fem;
  CheckTask task{.frozen = read_frozen_state(options.scene, options.time),
                 .directory = directory_of(options),
                 .quick = options.quick,
                 .required = options.required,
                 .n_ranks = options.ranks};
  if (options.from) task.span = read_time_span(options.scene.file, *options.from, task.frozen);
  for (const std::string& note : task.frozen.notes) fmt::print(stderr, "{}\n", note);
  task.on_solved = [first = true](const CheckFields& fields) mutable {
    print_solved(fields, std::exchange(first, false));
  };
  make_directory(task.directory);
  std::filesystem::remove(differences_file(task.directory));
  const FemProgram::Result result = compare_methods(fem, task);
  if (!result.json.is_null()) write_json(options.common, result.json);
  if (!options.no_plot && result.code != ExitCode::internal_error) draw_if_possible(task.directory);
  return result.code;
}

}  // namespace

void add_check_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("check", "Compare the fields of a frozen shape with finite elements");
  const auto options = std::make_shared<CheckOptions>();
  add_frozen_state(*command, options->scene.file);
  add_settings(*command, options->scene);
  add_snapshot_time(*command, options->time);
  command
      ->add_option("--from", options->from,
                   "Also advance V_m by finite elements from the snapshot of this time to the one that is checked")
      ->type_name("T")
      ->check(time_text());
  command
      ->add_option("-o,--output", options->directory,
                   "Directory for the results; \"check\" in that of a run, out/NAME_check for NAME.toml")
      ->type_name("DIR");
  command->add_flag("--quick", options->quick, "Coarse finite elements: 5 to 20 s of processor time for smooth shapes");
  command
      ->add_option("--require", options->required,
                   "Largest relative error of either method with which a row may agree; 0.02 if not given, 0.05 with "
                   "--quick")
      ->check(number_in(1e-9, 1.0));
  command
      ->add_option("--ranks", options->ranks,
                   "MPI processes of the finite elements; if not given, one for each free processor, at most eight")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-plot", options->no_plot, "Draw no picture");
  add_threads_option(*command);
  add_common_options(*command, options->common);
  command->footer(
      "Compares q, V_m, the electric force, the charging current and the velocity, and judges the numbers of the run, "
      "each with both methods' own error estimates.\n"
      "Exit code 0 if every row agrees within errors that are small enough; 4 if one does not, or if its errors are "
      "too large to tell (undecided). See docs/check.md.");
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace vehd
