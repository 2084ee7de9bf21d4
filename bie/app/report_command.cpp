#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <system_error>

#include "bie/app/commands.hpp"
#include "bie/pictures/report/report.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

struct ReportOptions {
  std::string directory;
  std::string output;
  std::size_t most_snapshots = ReportTask{}.most_snapshots;
  CommonOptions common;
};

ExitCode report(const ReportOptions& options) {
  const RunPaths paths{options.directory};
  const ReportTask task{paths, options.output.empty() ? paths.report() : std::filesystem::path(options.output),
                        options.most_snapshots};
  for (const auto& file : {paths.snapshots(), paths.history(), paths.history_error(), paths.vesicles(), paths.summary(),
                           paths.scene(), paths.checkpoint()}) {
    std::error_code ignored;
    if (!std::filesystem::equivalent(task.output, file, ignored)) continue;
    throw InputError(fmt::format("-o {}: is a file of the run; accepted: another", options.output));
  }
  const ReportSize size = write_report(task);
  for (const std::string& note : size.notes) fmt::print(stderr, "{}\n", note);
  fmt::print("{}: {} of {} snapshots, {:.1f} MB; open it in a browser\n", task.output.string(), size.snapshots,
             size.all, static_cast<double>(size.bytes) / 1e6);
  write_json(options.common, {{"report", task.output.string()},
                              {"snapshots", size.snapshots},
                              {"snapshots_of_run", size.all},
                              {"bytes", size.bytes}});
  return ExitCode::done;
}

}  // namespace

void add_report_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("report", "Write one HTML file that shows a run, in 3D as well");
  const auto options = std::make_shared<ReportOptions>();
  command->add_option("DIR", options->directory, "Directory of the run")->required();
  command->add_option("-o,--output", options->output, "The file; DIR/report.html if not given")->type_name("FILE");
  command
      ->add_option("--snapshots", options->most_snapshots,
                   "Most snapshots in the file, evenly spread; fewer if it would grow beyond 8 MB")
      ->type_name("N")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  add_common_options(*command, options->common);
  command->footer("The file needs nothing else: it opens offline, can be sent by mail and printed.");
  command->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace vehd
