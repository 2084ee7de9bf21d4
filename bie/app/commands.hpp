#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "bie/support/exit_code.hpp"
#include "bie/support/result_file.hpp"

/// One function per command: it adds the command's options and a callback that runs it and sets the exit code.
namespace vehd {

void add_run_command(CLI::App& program, ExitCode& exit_code);
void add_plot_command(CLI::App& program, ExitCode& exit_code);
void add_verify_command(CLI::App& program, ExitCode& exit_code);
void add_plan_command(CLI::App& program, ExitCode& exit_code);
void add_mesh_command(CLI::App& program, ExitCode& exit_code);
void add_check_command(CLI::App& program, ExitCode& exit_code);
void add_bench_command(CLI::App& program, ExitCode& exit_code);
void add_help_command(CLI::App& program, ExitCode& exit_code);

/// Options that every command has.
struct CommonOptions {
  std::optional<ResultFile> json;
};
void add_common_options(CLI::App& command, CommonOptions& options);

/// Writes the machine-readable result if it was asked for.
void write_json(const CommonOptions& options, const nlohmann::json& result);

}  // namespace vehd
