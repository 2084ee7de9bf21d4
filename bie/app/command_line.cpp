#include "bie/app/command_line.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <vector>

#include "bie/app/commands.hpp"
#include "bie/files/json_text.hpp"
#include "bie/files/versions.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/interruption.hpp"
#include "bie/support/memory.hpp"

namespace vehd {
namespace {

constexpr const char* footer =
    "Exit codes: 0 done, 1 wrong input or usage, 2 internal error,\n"
    "            3 the run stopped early and can be continued with --resume,\n"
    "            4 done, check failed.\n"
    "Scene files to start from: vehd examples; their keys: vehd help scene";

void send_messages_to_standard_error() {
  auto logger = spdlog::stderr_color_mt("vehd");
  logger->set_pattern("%^%l%$: %v");
  spdlog::set_default_logger(std::move(logger));
}

/// Silences this rank: only the first rank prints.
void silence_this_rank() {
  spdlog::set_level(spdlog::level::off);
  for (std::FILE* stream : {stdout, stderr}) {
    if (std::freopen("/dev/null", "w", stream) == nullptr) throw OutputError("/dev/null cannot be opened");
  }
}

std::string version_text() {
  std::string text = "vehd " + program_version();
  for (const auto& [library, version] : library_versions()) text += fmt::format("\n{} {}", library, version);
  return text;
}

/// Why a file cannot be an output of a command; empty unless another option names it too.
std::string problem_of_output(const CLI::App& command, const CLI::Option& output, const std::string& file) {
  for (const CLI::Option* other : command.get_options()) {
    if (other == &output) continue;
    for (const std::string& value : other->results()) {
      std::error_code ignored;
      if (std::filesystem::is_regular_file(value, ignored) && std::filesystem::equivalent(file, value, ignored)) {
        return fmt::format("{} is also given as {}; writing the result would overwrite it", file, other->get_name());
      }
    }
  }
  return "";
}

/// Refuses empty values, which would count as none, as of an unset variable of a shell, and outputs into an input.
void check_values(CLI::App& command) {
  const CLI::Validator given([](const std::string& text) { return text.empty() ? "is empty; accepted: a value" : ""; },
                             "");
  for (CLI::Option* option : command.get_options()) {
    option->check(given);
    if (option->get_name() != "--json" && option->get_name() != "--output") continue;
    const auto problem = [&command, option](const std::string& file) {
      return problem_of_output(command, *option, file);
    };
    option->check(CLI::Validator(problem, ""));
  }
  for (CLI::App* each : command.get_subcommands([](const CLI::App*) { return true; })) check_values(*each);
}

ExitCode fail(ExitCode code, const std::string& message) {
  fmt::print(stderr, "{}\n", message);
  return code;
}

/// Reports that standard output takes no more, for example on a full disk.
ExitCode cannot_print() { return fail(ExitCode::wrong_input, "standard output: cannot be written"); }

ExitCode parse_and_run(CLI::App& program, int argc, char** argv, ExitCode& exit_code) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {
      program.exit(error);
      return ExitCode::done;
    }
    const auto commands = program.get_subcommands();
    const std::string_view given = argc > 1 ? argv[1] : "";
    if (commands.empty() && !given.empty() && !given.starts_with('-')) {
      std::vector<std::string_view> names;
      for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(command->get_name());
      }
      return fail(ExitCode::wrong_input,
                  fmt::format("vehd: unknown command \"{}\"; {}; see vehd --help", given, suggestion(given, names)));
    }
    const std::string name = commands.empty() ? "vehd" : "vehd " + commands.front()->get_name();
    return fail(ExitCode::wrong_input, fmt::format("{}: {}; see {} --help", name, error.what(), name));
  } catch (const InputError& error) {
    return fail(ExitCode::wrong_input, error.what());
  } catch (const OutputError& error) {
    return fail(ExitCode::wrong_input, error.what());
  } catch (const Interrupted& error) {
    return fail(ExitCode::stopped_early, error.what());
  } catch (const ConvergenceError& error) {
    // Not a defect of the program: the input requires a higher resolution than it has.
    return fail(ExitCode::wrong_input, fmt::format("vehd {}: the input cannot be computed: {}",
                                                   program.get_subcommands().front()->get_name(), error.what()));
  } catch (const std::exception& error) {
    if (std::ferror(stdout) != 0) return cannot_print();
    return fail(ExitCode::internal_error, fmt::format("internal error: {}", error.what()));
  }
  return exit_code;
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  const auto choose = [&options](const std::string& file) { options.json.emplace(file); };
  command
      .add_option_function<std::string>("--json", choose,
                                        "Also write the result to this file as JSON; \"-\" is standard output, and "
                                        "all else then goes to standard error")
      ->type_name("FILE");
}

void write_json(const CommonOptions& options, const nlohmann::json& result) {
  if (options.json) options.json->write(json_text(result));
}

int run_program(int argc, char** argv, const Ranks& ranks) {
  keep_freed_memory();
  send_messages_to_standard_error();
  if (!ranks.is_first()) silence_this_rank();
  CLI::App program("Simulates a lipid vesicle in viscous flow and electric field by boundary integral equations.",
                   "vehd");
  program.set_version_flag("--version", version_text(), "Print the versions of the program and its libraries");
  program.require_subcommand(1);
  program.footer(footer);
  ExitCode exit_code = ExitCode::done;
  add_run_command(program, ranks, exit_code);
  add_sweep_command(program, exit_code);
  add_fit_command(program, exit_code);
  add_synthesise_command(program, exit_code);
  add_plot_command(program, exit_code);
  add_report_command(program, exit_code);
  add_plan_command(program, exit_code);
  add_verify_command(program, exit_code);
  add_mesh_command(program, exit_code);
  add_check_command(program, exit_code);
  add_bench_command(program, exit_code);
  add_examples_command(program, exit_code);
  add_completion_command(program, exit_code);
  add_help_command(program, exit_code);
  check_values(program);
  ExitCode code = parse_and_run(program, argc, argv, exit_code);
  if (code == ExitCode::done && (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)) code = cannot_print();
  // mpirun ends all ranks as soon as one returns anything but 0.
  return ranks.is_first() ? static_cast<int>(code) : 0;
}

}  // namespace vehd
