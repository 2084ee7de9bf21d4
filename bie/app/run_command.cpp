#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <memory>
#include <optional>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/runs/resumption.hpp"
#include "bie/runs/session.hpp"
#include "bie/scene/reader.hpp"

namespace vehd {
namespace {

struct RunOptions {
  SceneSource scene;
  std::string directory;
  std::string from;
  bool resume = false;
  bool no_plot = false;
  bool quiet = false;
  double checkpoint_every = std::chrono::duration<double>(longest_lag_of_files).count();
  CommonOptions common;
};

std::filesystem::path directory_of(const RunOptions& options) {
  return options.directory.empty() ? default_directory(options.scene.file) : std::filesystem::path(options.directory);
}

/// Advice for a run that has stopped.
std::string next_step(const RunOptions& options, const Scene& scene, const RunOutcome& outcome) {
  const std::string command =
      fmt::format("vehd run {} -o {} --resume", text_of(options.scene), shell_word(directory_of(options).string()));
  if (!outcome.cannot_step) return "continue with: " + command;
  return fmt::format("unchanged it would stop there again: {} of {}, then continue with: {}",
                     advice_after_failure(scene.numerics), options.scene.file.string(), command);
}

void print_summary(const nlohmann::json& summary, const RunPaths& paths) {
  const auto unit = summary["units"]["time"].get<std::string>();
  fmt::print("{} at time {:g}{}: {} steps ({} rejected) in {}\n",
             summary["completed"].get<bool>() ? "completed" : "stopped", summary["time"].get<double>(),
             unit == "1" ? "" : " " + unit, summary["steps"].get<int>(), summary["rejected_steps"].get<int>(),
             duration_text(summary["seconds"].get<double>()));
  fmt::print("bending energy ∫H² dA {:.6g}, area drift {:.1e}, volume drift {:.1e}, local strain {:.1e}\n",
             summary["bending_energy_scaled"].get<double>(), summary["area_drift"].get<double>(),
             summary["volume_drift"].get<double>(), summary["strain_max"].get<double>());
  if (summary.contains("poration")) {
    fmt::print("criterion of poration: {}\n", summary["poration"]["text"].get<std::string>());
  }
  if (summary.contains("error_bars") && summary["error_bars"].contains("text")) {
    fmt::print("largest estimated error: {}\n", summary["error_bars"]["text"].get<std::string>());
  }
  if (summary.contains("regime")) fmt::print("motion in shear: {}\n", summary["regime"].get<std::string>());
  if (const auto symmetry = summary["symmetry"].get<std::string>(); symmetry != "none") {
    fmt::print("symmetry: {} (imposed by the start: nothing that breaks it can grow)\n", symmetry);
  }
  for (const auto& warning : summary["warnings"]) {
    fmt::print("outside the model ({}): {}\n", warning["name"].get<std::string>(), warning["text"].get<std::string>());
  }
  fmt::print("verdict: {}\n", summary["verdict"].get<std::string>());
  fmt::print("files: {}\n", paths.directory.string());
}

/// A missing picture must not spoil a finished run.
void plot_if_possible(const RunPaths& paths) {
  try {
    for (const auto& picture : plot_run({paths, {}, paths.plots()}).pictures) {
      fmt::print("picture: {}\n", picture.string());
    }
  } catch (const std::exception& error) {
    spdlog::warn("no pictures: {}", error.what());
  }
}

ExitCode run(const RunOptions& options, const Ranks& ranks) {
  // Before anything runs in parallel, as threads inherit the signals that they block.
  std::optional<Interruption> interruption(std::in_place);
  const std::filesystem::path directory = directory_of(options);
  SceneSource source = options.scene;
  if (options.resume || !options.from.empty()) {
    source = in_scales_of(std::move(source), {options.from.empty() ? directory : std::filesystem::path(options.from)});
  }
  const Scene scene = read_scene(source);
  const RunSession session(scene, source, directory, options.resume, ranks, false, options.from);
  if (session.is_complete()) {
    if (!ranks.is_first()) return ExitCode::done;
    fmt::print("{}: the run is already complete, nothing to do\n", session.paths().directory.string());
    write_json(options.common, session.last_summary());
    return ExitCode::done;
  }
  for (const SceneChange& change : session.changes()) fmt::print("changed at {}\n", text_of(change));
  Progress progress(options.quiet || !ranks.is_first() ? Progress::Style::none : Progress::suitable_style());
  const auto show = [&progress](const RunStatus& status) { show_run(progress, status); };
  const auto checkpoint_lag =
      std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::duration<double>(options.checkpoint_every));
  const RunOutcome outcome = simulate(session.task(show, checkpoint_lag), *interruption);
  progress.finish();
  interruption.reset();
  if (!ranks.is_first()) return outcome.completed ? ExitCode::done : ExitCode::stopped_early;
  nlohmann::json summary;
  try {
    summary = session.summarise(outcome);
  } catch (const std::runtime_error& error) {
    // On a full disk or without the directory there is no summary either; the reason of the stop is more important.
    if (outcome.completed) throw;
    fmt::print(stderr, "{}\n{}\n", outcome.reason, error.what());
    return ExitCode::stopped_early;
  }
  print_summary(summary, session.paths());
  write_json(options.common, summary);
  if (!outcome.completed) {
    fmt::print(stderr, "{}; {}\n", outcome.reason, next_step(options, scene, outcome));
    return ExitCode::stopped_early;
  }
  if (!options.no_plot) plot_if_possible(session.paths());
  return ExitCode::done;
}

}  // namespace

void show_run(Progress& progress, const RunStatus& status) {
  const double done = status.time - status.start_time;
  const std::string left =
      done > 0.0 ? duration_text(status.seconds / done * std::max(0.0, status.end_time - status.time)) : "?";
  const std::string unit = status.time_unit.empty() ? "" : " " + status.time_unit;
  const std::string gap = status.gap.empty() ? "" : "  gap " + status.gap;
  progress.update(status.end_time > 0.0 ? status.time / status.end_time : 1.0,
                  fmt::format("step {}  t {:.4g}/{:.4g}{}  dt {:.3g}  drift {:.1e}{}  left {}", status.step,
                              status.time, status.end_time, unit, status.dt, status.drift, gap, left));
}

void add_run_command(CLI::App& program, const Ranks& ranks, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene");
  const auto options = std::make_shared<RunOptions>();
  add_scene_choice(*command, options->scene);
  command
      ->add_option("-o,--output", options->directory,
                   "Directory for the files of the run, created if missing; out/NAME of NAME.toml if not given")
      ->type_name("DIR");
  command
      ->add_option("--from", options->from,
                   "Continue the run in RUN from its last state and time, also with another [flow], field or waveform")
      ->type_name("RUN");
  command->add_flag("--resume", options->resume,
                    "Continue the run in DIR, also with other [numerics] and [output]; start it if there is none");
  command
      ->add_option("--checkpoint-every", options->checkpoint_every,
                   "Least time between two checkpoints, which a kill may lose; 0: one after every step")
      ->type_name("SECONDS")
      ->check(number_in(0.0, 86400.0))
      ->capture_default_str();
  command->add_flag("--no-plot", options->no_plot, "Draw no pictures at the end");
  command->add_flag("--quiet", options->quiet, "Show no progress");
  add_threads_option(*command);
  add_common_options(*command, options->common);
  command->footer(
      "Writes history.csv, run.h5, run.xdmf (ParaView), summary.json, scene.toml and plots/.\n"
      "Ctrl-C finishes the current step and leaves a run that --resume continues.");
  command->callback(
      [options, ranks, &exit_code] { exit_code = ranks.collective([&] { return run(*options, ranks); }); });
}

}  // namespace vehd
