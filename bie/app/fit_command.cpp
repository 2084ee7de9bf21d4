#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/fit/fit_output.hpp"
#include "bie/fit/fit_picture.hpp"
#include "bie/support/progress.hpp"
#include "bie/support/text_table.hpp"
#include "bie/support/thread_count.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

struct FitOptions {
  fs::path file;
  std::string directory;
  WorkerOptions workers;
  bool no_plot = false;
  bool quiet = false;
  CommonOptions common;

  [[nodiscard]] FitPaths paths() const { return {directory.empty() ? default_directory(file) : fs::path(directory)}; }
};

void print_fit(const FitFile& fit, const FitResult& result, const FitPaths& paths) {
  TextTable rows = {{"key", "value", "standard error", "unit"}};
  for (std::size_t k = 0; k < fit.keys.size(); ++k) {
    const double error = fit.keys[k].error_of(result.values[k], result.statistics.errors[static_cast<Index>(k)]);
    rows.push_back({fit.keys[k].name, fmt::format("{:.5g}", result.values[k]),
                    std::isfinite(error) ? fmt::format("{:.2g}", error) : "not determined", fit.keys[k].unit});
  }
  fmt::print("{}χ² = {:.4g} with {} degrees of freedom, {} evaluations of the model\n", aligned(rows, ""),
             result.minimum.chi2(), result.minimum.residuals.size() - std::ssize(fit.keys),
             result.minimum.n_evaluations);
  for (const Combination& combination : result.statistics.undetermined) {
    fmt::print("not determined: {} changes the data by less than the runs' error\n", text_of(fit, combination));
  }
  for (const Index k : result.minimum.at_end) {
    fmt::print("{} is at the end of its interval: the data fit better beyond it\n",
               fit.keys[static_cast<std::size_t>(k)].name);
  }
  fmt::print("files: {}\n", paths.directory.string());
}

void draw_if_possible(const FitFile& fit, const FitResult& result, const FitPaths& paths) {
  try {
    draw_fit(fit, result, {paths.picture(), PictureFormat::png});
    fmt::print("picture: {}\n", paths.picture().string());
  } catch (const std::exception& error) {
    spdlog::warn("no picture: {}", error.what());
  }
}

ExitCode fit(const FitOptions& options) {
  // One thread until the workers are started: they are copies of this process, without its other threads.
  const ThreadCount one(1);
  const FitFile file = read_fit(options.file);
  const FitPaths paths = options.paths();
  FitResult result;
  {
    Interruption interruption;
    Progress progress(options.quiet ? Progress::Style::none : Progress::suitable_style());
    int n_evaluations = 0;
    std::string chi2 = "?";
    const auto show = [&](std::int64_t n_finished, std::int64_t n_runs, double share) {
      progress.update(share,
                      fmt::format("{} evaluations  χ² {}  now {}/{} runs", n_evaluations, chi2, n_finished, n_runs));
    };
    const ModelRuns runs(file.experiments, {paths.directory, options.workers.jobs(), options.workers.n_threads, show},
                         interruption);
    try {
      result = fit_keys(file, runs, [&](int count, double least) {
        n_evaluations = count;
        chi2 = fmt::format("{:.4g}", least);
      });
    } catch (const Interrupted& end) {
      progress.finish();
      fmt::print(stderr, "{}; the same command continues from here\n", end.what());
      return ExitCode::stopped_early;
    }
    progress.finish();
  }
  write_fit(paths, file, result);
  print_fit(file, result, paths);
  write_json(options.common, json_of(file, result));
  if (!options.no_plot) draw_if_possible(file, result, paths);
  if (result.minimum.converged) return ExitCode::done;
  fmt::print(stderr, "χ² still fell after {} evaluations: give narrower intervals, or a start nearer to the data\n",
             result.minimum.n_evaluations);
  return ExitCode::check_failed;
}

}  // namespace

void add_fit_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("fit", "Fit keys of a scene to measured data");
  const auto options = std::make_shared<FitOptions>();
  command->add_option("FIT", options->file, "Fit file (TOML): [[experiment]] and [free]")->required();
  command
      ->add_option("-o,--output", options->directory,
                   "Directory for the results and the runs, created if missing; out/NAME of NAME.toml if not given")
      ->type_name("DIR");
  add_workers(*command, options->workers);
  command->add_flag("--no-plot", options->no_plot, "Draw no picture");
  command->add_flag("--quiet", options->quiet, "Show no progress");
  add_common_options(*command, options->common);
  command->footer(
      "Writes fit.json, fit.csv, fit.png, best.toml (best_NAME.toml of several experiments) and the runs below runs/.\n"
      "After a Ctrl-C or a crash the same command continues with the finished runs. See docs/fit.md.");
  command->callback([options, &exit_code] { exit_code = fit(*options); });
}

}  // namespace vehd
