#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>
#include <thread>

#include "bie/comparison/check_input.hpp"
#include "bie/pictures/differences.hpp"
#include "bie/app/commands.hpp"
#include "bie/comparison/fem_program.hpp"
#include "bie/scene/scene.hpp"
#include "bie/sphere/harmonics.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// The coarse mesh has a few hundred cells: more processes would have too few each.
constexpr int most_default_ranks = 8;

int default_ranks() { return std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, most_default_ranks); }

struct CheckOptions {
  std::string file;
  std::optional<double> time;
  std::string directory;
  bool quick = false;
  bool no_plot = false;
  int ranks = default_ranks();
  CommonOptions common;
};

/// Beyond it the quick check would not be quick; an order above it is kept.
constexpr int highest_quick_order = 28;

int high_order(int order, bool quick) {
  // Boundary integrals are cheap beside fine elements; their error must not be what the comparison ends on.
  const int raised = quick ? (3 * order + 1) / 2 : 2 * order;
  return std::clamp(raised, std::min(order + 2, highest_order),
                    quick ? std::max(highest_quick_order, order + 2) : highest_order);
}

std::filesystem::path directory_of(const CheckOptions& options) {
  if (!options.directory.empty()) return options.directory;
  const std::filesystem::path file = options.file;
  if (file.extension() == ".toml") return std::filesystem::path("out") / (file.stem().string() + "_check");
  return file.parent_path() / "check";
}

void make_directory(const std::filesystem::path& directory) {
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw OutputError(fmt::format("{}: cannot be created: {}", directory.string(), error.message()));
}

/// A missing picture must not spoil a finished comparison.
void draw_if_possible(const std::filesystem::path& directory) {
  try {
    if (draw_differences(directory)) fmt::print("picture: {}\n", (directory / "differences.png").string());
  } catch (const std::exception& error) {
    spdlog::warn("no picture: {}", error.what());
  }
}

ExitCode check(const CheckOptions& options) {
  const FemProgram fem;
  const FrozenState frozen = read_frozen_state(options.file, options.time);
  if (!frozen.note.empty()) fmt::print(stderr, "{}\n", frozen.note);
  const CheckContents contents = check_contents(frozen);
  const Matrix force = contents.flow ? given_force(frozen) : Matrix();
  const std::filesystem::path directory = directory_of(options);
  make_directory(directory);

  const CheckSamples samples = check_samples(frozen.state.position);
  const int order = order_of(frozen.state.position.rows());
  const int raised = high_order(order, options.quick);
  const CheckFields at_order = check_fields(frozen, contents, force, order, samples.points);
  fmt::print(stderr, "boundary integrals: order {} in {:.1f} s", order, at_order.seconds);
  const CheckFields at_high_order = check_fields(frozen, contents, force, raised, samples.points);
  fmt::print(stderr, ", order {} in {:.1f} s\n", raised, at_high_order.seconds);
  const std::filesystem::path input = directory / "check_input.h5";
  std::filesystem::remove(differences_file(directory));
  write_check_input(input, {frozen, contents, force, samples, at_order, at_high_order});

  std::vector<std::string> arguments{"check", input.string(), "-o", directory.string()};
  if (options.quick) arguments.emplace_back("--quick");
  const FemProgram::Result result = fem.run(arguments, options.ranks);
  if (!result.json.is_null()) write_json(options.common, result.json);
  if (!options.no_plot && result.code != ExitCode::internal_error) draw_if_possible(directory);
  return result.code;
}

}  // namespace

void add_check_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("check", "Compare the fields of a frozen shape with finite elements");
  const auto options = std::make_shared<CheckOptions>();
  command->add_option("FILE", options->file, "run.h5 of a run, or a scene (.toml) for its initial state")->required();
  command->add_option("--time", options->time, "Time; the nearest snapshot is taken, the last one if left out");
  command
      ->add_option("-o,--output", options->directory,
                   "Directory for the results; \"check\" beside a run.h5, out/NAME_check for NAME.toml")
      ->type_name("DIR");
  command->add_flag("--quick", options->quick, "Coarse finite elements: about ten seconds");
  command->add_option("--ranks", options->ranks, "MPI processes of the finite elements")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_flag("--no-plot", options->no_plot, "Draw no picture");
  add_common_options(*command, options->common);
  command->footer(
      "Compares q, V_m, the electric force and the velocity, each with both methods' own error estimates.\n"
      "Exit code 0 if every field agrees within the two errors, 4 if one does not. See docs/check.md.");
  command->callback([options, &exit_code] { exit_code = check(*options); });
}

}  // namespace vehd
