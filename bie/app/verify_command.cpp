#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/bench/exact_problems.hpp"
#include "bie/scene/scene.hpp"
#include "bie/sphere/degrees.hpp"

namespace vehd {
namespace {

struct VerifyOptions {
  int order = 16;
  CommonOptions common;
};

ExitCode verify(const VerifyOptions& options) {
  const Example1Result result = solve_example1(options.order);
  fmt::print("Example 1: shape (33), sigma_i = 2, sigma_e = 1, six point sources\n");
  fmt::print("{:>6} {:>10} {:>10} {:>11} {:>9}\n", "degree", "error_q", "error_f_E", "iterations", "seconds");
  fmt::print("{:>6} {:>10.2e} {:>10.2e} {:>11} {:>9.3f}\n", result.order, result.errors.charge, result.errors.force,
             result.errors.report.iterations, result.seconds);
  write_json(options.common, {{"order", result.order},
                              {"error_q", result.errors.charge},
                              {"error_force", result.errors.force},
                              {"iterations", result.errors.report.iterations},
                              {"seconds", result.seconds}});
  return ExitCode::done;
}

}  // namespace

void add_verify_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("verify", "Solve Example 1 of the paper and print its errors");
  const auto options = std::make_shared<VerifyOptions>();
  command->add_option("--degree,--order", options->order, "Degree p of the harmonics")
      ->check(CLI::Range(lowest_order, highest_order))
      ->capture_default_str();
  add_threads_option(*command);
  add_common_options(*command, options->common);
  command->footer("Errors are relative maxima over the 2(p+1)^2 nodes against the exact solution.");
  command->callback([options, &exit_code] { exit_code = verify(*options); });
}

}  // namespace vehd
