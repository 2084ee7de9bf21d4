#include <fmt/format.h>

#include <memory>

#include "bie/app/commands.hpp"
#include "bie/pictures/movie.hpp"
#include "bie/pictures/plots.hpp"

namespace vehd {
namespace {

struct PlotOptions {
  std::string directory;
  std::string output;
  std::vector<double> times;
  bool movie = false;
  CommonOptions common;
};

ExitCode plot(const PlotOptions& options) {
  const RunPaths paths{options.directory};
  const PlotTask task{paths, options.times,
                      options.output.empty() ? paths.plots() : std::filesystem::path(options.output)};
  const auto pictures = plot_run(task);
  nlohmann::json result;
  const RunReader run(paths.snapshots());
  for (const SnapshotChoice& shape : shapes_to_plot(task, run)) {
    if (!shape.note.empty()) fmt::print(stderr, "{}\n", shape.note);
    result["times"].push_back(run.times()[shape.snapshot]);
  }
  for (const auto& picture : pictures) {
    fmt::print("{}\n", picture.string());
    result["pictures"].push_back(picture.string());
  }
  if (options.movie) {
    Progress progress(Progress::suitable_style());
    const std::filesystem::path movie = plot_movie(task, progress);
    progress.clear();
    fmt::print("{}\n", movie.string());
    result["movie"] = movie.string();
  }
  write_json(options.common, result);
  return ExitCode::done;
}

}  // namespace

void add_plot_command(CLI::App& program, ExitCode& exit_code) {
  CLI::App* command = program.add_subcommand("plot", "Draw pictures (PNG) of a run");
  const auto options = std::make_shared<PlotOptions>();
  command->add_option("DIR", options->directory, "Directory of the run")->required();
  command->add_option("-o,--output", options->output, "Directory for the pictures; DIR/plots if not given")
      ->type_name("DIR");
  command
      ->add_option("--times", options->times,
                   "Times of the shapes, at most 6, or evenly spread; the nearest snapshots are taken")
      ->delimiter(',')
      ->type_name("T,T,...")
      ->expected(1, 6);
  command->add_flag("--movie", options->movie, "Also write movie.mp4, a picture for each snapshot; needs ffmpeg");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] { exit_code = plot(*options); });
}

}  // namespace vehd
