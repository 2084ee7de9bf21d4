#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "bie/runs/run_status.hpp"
#include "bie/support/exit_code.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/progress.hpp"
#include "bie/support/ranks/ranks.hpp"

/// One function per command: it adds the command's options and a callback that runs it and sets the exit code.
namespace vehd {

/// vehd run: simulates a scene.
/// @param ranks  ranks that simulate it together
void add_run_command(CLI::App& program, const Ranks& ranks, ExitCode& exit_code);
/// vehd sweep: simulates a scene for many values of its keys.
void add_sweep_command(CLI::App& program, ExitCode& exit_code);
/// vehd fit: fits keys of a scene to measured data.
void add_fit_command(CLI::App& program, ExitCode& exit_code);
/// vehd synthesise: makes data with noise from a scene.
void add_synthesise_command(CLI::App& program, ExitCode& exit_code);
/// vehd plot: pictures of a run, or of a sweep.
void add_plot_command(CLI::App& program, ExitCode& exit_code);
/// vehd report: one HTML file that shows a run.
void add_report_command(CLI::App& program, ExitCode& exit_code);
/// vehd verify: Example 1 of the paper.
void add_verify_command(CLI::App& program, ExitCode& exit_code);
/// vehd plan: effects, operators and cost of a run.
void add_plan_command(CLI::App& program, ExitCode& exit_code);
/// vehd mesh: volume mesh of a frozen shape.
void add_mesh_command(CLI::App& program, ExitCode& exit_code);
/// vehd check: compares with the finite elements.
void add_check_command(CLI::App& program, ExitCode& exit_code);
/// vehd bench: the cost of accuracy.
void add_bench_command(CLI::App& program, ExitCode& exit_code);
/// vehd examples: the scenes that come with the program.
void add_examples_command(CLI::App& program, ExitCode& exit_code);
/// vehd help: reference of the scene keys; added last, as it includes the help of every command added before.
void add_help_command(CLI::App& program, ExitCode& exit_code);
/// `vehd completion SHELL`: a script that completes commands and options, made from the same table as the help.
void add_completion_command(CLI::App& program, ExitCode& exit_code);

/// Options of every command.
struct CommonOptions {
  std::optional<ResultFile> json;
};
/// Adds --json.
void add_common_options(CLI::App& command, CommonOptions& options);

/// Writes the machine-readable result if it was requested.
void write_json(const CommonOptions& options, const nlohmann::json& result);

/// Shows the progress of a run and the estimated time for the rest of it.
void show_run(Progress& progress, const RunStatus& status);

}  // namespace vehd
