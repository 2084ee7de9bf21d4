#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bie/files/run_reader.hpp"
#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/shape_field.hpp"
#include "bie/pictures/sweep_rows.hpp"
#include "bie/runs/run_directory.hpp"
#include "bie/support/progress.hpp"

namespace vehd {

/// Appearance of shapes.
struct ShapesStyle {
  std::string view{};    ///< see parse_view; empty: perpendicular to the plane of flow and field
  std::string field{};   ///< that gives the colours, a name of shape_fields; empty: default_field
  bool section = false;  ///< leaves out the half towards the eye
  double width = 510.0;  ///< largest width of the page in points
};

/// The pictures to draw, and their destination.
struct PlotTask {
  RunPaths paths;
  /// Times of the shapes as users write them, see GivenTimes; empty: chosen by how much the shape changes.
  std::vector<std::string> times;
  std::filesystem::path output;  ///< directory for the pictures
  PictureFormat format = PictureFormat::png;
  ShapesStyle style{};
};

/// Pictures of plot_run.
struct PlotResult {
  std::vector<std::filesystem::path> pictures;
  std::vector<double> times;         ///< of the shapes, in time_unit
  std::string time_unit = "1";       ///< in which the run shows times; "1": dimensionless
  std::vector<std::string> notes{};  ///< requested times that have no snapshot
};

/// @throws InputError if the directory holds no run
void require_run(const RunPaths& paths);

/// Draws the pictures of a run through gnuplot, OUTPUT/shapes.FORMAT and OUTPUT/history.FORMAT; needs no display.
/// @throws InputError if the run cannot be read or gnuplot is missing
PlotResult plot_run(const PlotTask& task);

/// The snapshots in the picture of shapes, each once, in the order of the given times; a note reports a different time.
/// @throws InputError if there are too many times or one of them is not in the run
std::vector<SnapshotChoice> shapes_to_plot(const PlotTask& task, const RunReader& run);

/// Shapes at one scale in parallel projection, with axes, arrows of flow and field, a scale bar and colours.
/// @throws InputError
PlotResult plot_shapes(const PlotTask& task, const PictureFile& picture);

/// Draws the panels of the history against time that are significant for this run.
/// @return false if there is none
/// @throws InputError
bool plot_history(const PlotTask& task, const PictureFile& picture);

/// Largest number of shapes in one picture.
constexpr std::size_t most_shapes = 6;

/// Draws picture number i to a PNG file.
using FrameDrawer = std::function<void(std::size_t i, const std::filesystem::path& picture)>;

/// Draws single shapes as `plot_shapes` does, all at one scale and with the same colours.
/// @param snapshots  one for each picture; each is read only once, in this call
/// @throws InputError
FrameDrawer shape_frames(const PlotTask& task, const RunReader& run, const std::vector<std::size_t>& snapshots);

/// Draws the movie of a run, OUTPUT/movie.mp4, from all snapshots or, if there are many, from evenly spread ones.
/// @return path of the movie
/// @throws InputError if the run cannot be read, or gnuplot or ffmpeg is missing
std::filesystem::path plot_movie(const PlotTask& task, Progress& progress);

/// The pictures of a sweep to draw, and their destination.
struct SweepPlotTask {
  SweepPaths paths;
  std::vector<std::string> columns;  ///< plain names; empty: all but the time
  std::optional<double> border;      ///< value of a column at which a border is shown; absent: see plot_sweep
  std::filesystem::path curves;      ///< file of curves over maps, see read_sweep_curves; empty: none
  std::filesystem::path output;      ///< folder
  PictureFormat format = PictureFormat::png;
};

/// Draws the table of a sweep. Of one key, or of several that change together: OUTPUT/lines.FORMAT, each column against
/// the (first) key. Of a grid of two keys: OUTPUT/map_COLUMN.FORMAT for each column, with a cell for each run. Of a
/// sweep that also varies a seed: OUTPUT/lines.FORMAT and OUTPUT/lines.csv, means over the seed, see draw_sweep_means.
/// Refused runs have no point and a white cell; stopped runs have grey points and a cross in their cell. A border is a
/// line at a value of the column, 1 of the aspect ratio along the field, 0 of a column of both signs; in a map it runs
/// between cells on its two sides.
/// @return the pictures
/// @throws InputError if there is no table, it lacks such a column, or it has three keys or more
std::vector<std::filesystem::path> plot_sweep(const SweepPlotTask& task);

/// DIR/differences.dat: text, columns named in the first line, one block of lattice lines for every face.
std::filesystem::path differences_file(const std::filesystem::path& directory);

/// Draws DIR/differences.png, the differences of both methods on the membrane, from the data file that the
/// finite-element program has written to DIR.
/// @return false if there is no such file
/// @throws InputError if gnuplot is missing or reports an error
bool draw_differences(const std::filesystem::path& directory);

}  // namespace vehd
