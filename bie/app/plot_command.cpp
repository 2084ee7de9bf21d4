#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>

#include "bie/app/commands.hpp"
#include "bie/app/scene_choice.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

struct PlotOptions {
  std::string directory;
  std::string output;
  std::string format;
  std::vector<std::string> times, columns;
  std::optional<double> border;
  std::string curves;
  ShapesStyle style;
  bool movie = false;
  CommonOptions common;
};

PlotTask task_of(const PlotOptions& options) {
  const RunPaths paths{options.directory};
  PlotTask task{paths, options.times, options.output.empty() ? paths.plots() : std::filesystem::path(options.output)};
  task.style = options.style;
  if (!options.format.empty()) {
    task.format =
        static_cast<PictureFormat>(std::ranges::find(picture_formats, options.format) - picture_formats.begin());
  }
  return task;
}

/// Draws the shapes only, into a file of this name.
PlotResult plot_file(const PlotOptions& options, const PlotTask& task, PictureFormat format) {
  if (!options.format.empty() && task.format != format) {
    throw InputError(fmt::format("--format {}: -o {} has another extension", options.format, options.output));
  }
  const auto folder = task.output.parent_path();
  if (!folder.empty()) make_directory(folder);
  return plot_shapes(task, {task.output, format});
}

/// Draws the table of a sweep.
ExitCode plot_table(const PlotOptions& options, const PlotTask& task) {
  const auto pictures =
      plot_sweep({{options.directory}, options.columns, options.border, options.curves, task.output, task.format});
  nlohmann::json result;
  for (const auto& picture : pictures) {
    fmt::print("{}\n", picture.string());
    result["pictures"].push_back(picture.string());
  }
  write_json(options.common, result);
  return ExitCode::done;
}

ExitCode plot(const PlotOptions& options) {
  const PlotTask task = task_of(options);
  if (is_sweep(options.directory)) {
    if (!options.times.empty() || options.movie || options.style.section || !options.style.view.empty() ||
        !options.style.field.empty()) {
      throw InputError(
          fmt::format("{}: is a sweep; --times, --view, --field, --section and --movie are for pictures of runs",
                      options.directory));
    }
    if (options.border && !std::isfinite(*options.border)) {
      throw InputError(fmt::format("--border: is {}; accepted: a finite number", *options.border));
    }
    return plot_table(options, task);
  }
  if (!options.columns.empty() || options.border || !options.curves.empty()) {
    throw InputError(fmt::format("{}: is not a sweep; --column, --border and --curve are for pictures of sweeps",
                                 options.directory));
  }
  const auto format = format_of(options.output);
  if (options.movie && format) {
    throw InputError(fmt::format("--movie: -o {} is a picture; accepted: a directory", options.output));
  }
  const PlotResult drawn = format ? plot_file(options, task, *format) : plot_run(task);
  for (const std::string& note : drawn.notes) fmt::print(stderr, "{}\n", note);
  nlohmann::json result{{"times", drawn.times}, {"time_unit", drawn.time_unit}};
  for (const auto& picture : drawn.pictures) {
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
  CLI::App* command =
      program.add_subcommand("plot", "Draw pictures of a run: shapes, and histories against time; or of a sweep");
  const auto options = std::make_shared<PlotOptions>();
  std::vector<std::string> field_names;
  for (const ShapeField& field : shape_fields) field_names.emplace_back(field.name);
  command->add_option("DIR", options->directory, "Directory of the run or the sweep")->required();
  command
      ->add_option("-o,--output", options->output,
                   "Directory for the pictures, DIR/plots if not given; or a file of shapes, NAME.pdf for example")
      ->type_name("PLACE");
  command
      ->add_option(
          "--times", options->times,
          fmt::format("Times of the shapes as \"0.5 ms\", or numbers in the unit of history.csv, at most {}, of the "
                      "nearest snapshots; if not given as many, chosen such that the shape changes evenly",
                      most_shapes))
      ->delimiter(',')
      ->type_name("T,T,...")
      ->expected(1, most_shapes)
      ->check(time_text());
  command
      ->add_option("--view", options->style.view,
                   "Direction of view: along x, y or z, or a direction towards the eye as 1,1,0.5; across the plane "
                   "of flow and field if not given")
      ->type_name("VIEW");
  command
      ->add_option(
          "--field", options->style.field,
          "Field that colours the shapes; force: its magnitude. If not given, V_m, or the tension if there is no V_m")
      ->type_name("FIELD")
      ->check(CLI::IsMember(field_names));
  command->add_flag("--section", options->style.section,
                    "Leave out the half towards the eye: the cut and the inside of the membrane show");
  command->add_option("--format", options->format, "Format of the pictures; png if not given")
      ->type_name("FORMAT")
      ->check(CLI::IsMember(std::vector<std::string>(picture_formats.begin(), picture_formats.end())));
  command->add_flag("--movie", options->movie, "Also write movie.mp4, a picture for each snapshot; needs ffmpeg");
  command->add_option("--column", options->columns, "Of a sweep: only these columns of its table")
      ->type_name("NAME")
      ->delimiter(',');
  command
      ->add_option("--border", options->border,
                   "Of a sweep: the value of the column at which a line is drawn; if not given 1 for a ratio of "
                   "lengths and 0 for a column of both signs")
      ->type_name("VALUE");
  command
      ->add_option(
          "--curve", options->curves,
          "Of a sweep of two keys: a CSV file of both, in the units of its table, whose rows are drawn as a red "
          "line, for example a known border; an empty line begins another one")
      ->type_name("FILE")
      ->check(CLI::ExistingFile);
  command->footer("See docs/pictures.md, of sweeps docs/sweeps.md.");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] { exit_code = plot(*options); });
}

}  // namespace vehd
