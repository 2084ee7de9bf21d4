#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/fit/synthesis.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/progress.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

struct SynthesiseOptions {
  Synthesis synthesis;
  SceneSource scene;
  std::string vary;
  std::filesystem::path output;
  WorkerOptions workers;
  bool quiet = false;
  CommonOptions common;
};

/// Reads the key and its values from "table.key=1 kHz,10 kHz".
void read_varied(Synthesis& synthesis, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (text.empty()) return;
  if (equals == std::string::npos || equals + 1 == text.size()) {
    throw InputError(fmt::format("--vary {}: accepted: table.key=VALUE,VALUE,...", text));
  }
  synthesis.key = text.substr(0, equals);
  for (std::size_t from = equals + 1; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    synthesis.values.push_back(text.substr(from, comma - from));
    from = comma + 1;
  }
}

ExitCode synthesise(const SynthesiseOptions& options) {
  const ThreadCount one(1);
  Synthesis synthesis = options.synthesis;
  synthesis.source = options.scene;
  read_varied(synthesis, options.vary);
  const Experiment experiment = experiment_of(synthesis);
  if (std::filesystem::exists(options.output)) {
    throw InputError(fmt::format("-o {}: exists already; accepted: a new file", options.output.string()));
  }
  if (options.output.has_parent_path()) make_directory(options.output.parent_path());
  Vector values;
  {
    const TemporaryFolder folder("vehd-synthesis");
    Interruption interruption;
    Progress progress(options.quiet ? Progress::Style::none : Progress::suitable_style());
    const auto show = [&](std::int64_t n_finished, std::int64_t n_runs, double share) {
      progress.update(share, fmt::format("{}/{} runs", n_finished, n_runs));
    };
    const RunWork work{folder.path(), options.workers.jobs(), options.workers.n_threads, show};
    values = simulated_values(experiment, work, interruption);
    progress.finish();
  }
  replace_file(options.output, synthetic_data(synthesis, experiment, values));
  fmt::print("data: {}, {} values\n", options.output.string(), values.size());
  write_json(options.common, {{"data", options.output.string()}, {"values", values.size()}});
  return ExitCode::done;
}

}  // namespace

void add_synthesise_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("synthesise", "Make data with noise from a scene");
  const auto options = std::make_shared<SynthesiseOptions>();
  Synthesis& synthesis = options->synthesis;
  add_scene_choice(*command, options->scene);
  command->add_option("-o,--output", options->output, "File of the data (CSV)")->type_name("FILE")->required();
  command
      ->add_option("--quantity", synthesis.quantity,
                   "Column of history.csv, or contour: r(phi) of the section in the x-z plane")
      ->type_name("NAME")
      ->required();
  command->add_option("--noise", synthesis.noise, "Standard deviation of each value, as in 0.01 or \"2 mV\"")
      ->type_name("SIZE")
      ->required();
  command->add_option("--seed", synthesis.seed, "Seed of the noise")
      ->type_name("N")
      ->check(CLI::Validator(
          [](const std::string& text) { return text.starts_with('-') ? text + " is below 0" : std::string(); }, ""))
      ->capture_default_str();
  command
      ->add_option("--vary", options->vary,
                   "A value at the end of a run for each of these, in place of one at each snapshot, as in "
                   "\"electric.waveform.frequency=1 kHz,10 kHz\"")
      ->type_name("TABLE.KEY=VALUES");
  command->add_option("--angles", synthesis.n_angles, "Number of evenly spaced angles of a contour; 64 if not given")
      ->type_name("N")
      ->check(CLI::Range(1, 10000));
  command
      ->add_option("--pixel", synthesis.pixel,
                   "Points of a contour come to the nearest pixel of this side, as in \"0.1 um\"")
      ->type_name("SIZE");
  add_workers(*command, options->workers);
  command->add_flag("--quiet", options->quiet, "Show no progress");
  add_common_options(*command, options->common);
  command->footer(
      "The scene runs with a tolerance of a hundredth of the noise. The rows have the times and units of its\n"
      "history.csv, and a column of standard deviations, as vehd fit reads them. See docs/fit.md.");
  command->callback([options, &exit_code] { exit_code = synthesise(*options); });
}

}  // namespace vehd
