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

/// How shapes are shown.
struct ShapesStyle {
  std::string view{};    ///< see parse_view; empty: across the plane of flow and field
  std::string field{};   ///< of the colours, a name of shape_fields; empty: default_field
  bool section = false;  ///< without the half towards the eye
  double width = 510.0;  ///< of the page in points, at most
};

/// Which pictures are drawn, and where they go.
struct PlotTask {
  RunPaths paths;
  /// Of the shapes as people write them, see GivenTimes; empty: chosen by how much the shape changes.
  std::vector<std::string> times;
  std::filesystem::path output;  ///< directory for the pictures
  PictureFormat format = PictureFormat::png;
  ShapesStyle style{};
};

/// Pictures of plot_run.
struct PlotResult {
  std::vector<std::filesystem::path> pictures;
  std::vector<double> times;         ///< of the shapes, in the unit
  std::string time_unit = "1";       ///< in which the run shows them; "1" of a pure number
  std::vector<std::string> notes{};  ///< times that were asked for and have no snapshot of their own
};

/// @throws InputError if the directory holds no run
void require_run(const RunPaths& paths);

/// Draws the pictures of a run through gnuplot, OUTPUT/shapes.FORMAT and OUTPUT/history.FORMAT; needs no display.
/// @throws InputError if the run cannot be read or gnuplot is missing
PlotResult plot_run(const PlotTask& task);

/// The snapshots of the picture of shapes, each once, in the order of given times; those with a note have another time.
/// @throws InputError if there are too many times or one of them is none of the run
std::vector<SnapshotChoice> shapes_to_plot(const PlotTask& task, const RunReader& run);

/// Shapes at one scale in parallel projection, with axes, arrows of flow and field, a scale bar and colours.
/// @throws InputError
PlotResult plot_shapes(const PlotTask& task, const PictureFile& picture);

/// Panels of the history against time: those that tell something of this run.
/// @return false if none does
/// @throws InputError
bool plot_history(const PlotTask& task, const PictureFile& picture);

/// Most shapes in one picture.
constexpr std::size_t most_shapes = 6;

/// Draws picture number i to a PNG file.
using FrameDrawer = std::function<void(std::size_t i, const std::filesystem::path& picture)>;

/// Pictures of single shapes as those of `plot_shapes`, all at one scale and with the same colours.
/// @param snapshots  one for each picture; each is read once, here
/// @throws InputError
FrameDrawer shape_frames(const PlotTask& task, const RunReader& run, const std::vector<std::size_t>& snapshots);

/// The movie of a run, OUTPUT/movie.mp4, of all snapshots or of many of them, evenly spread.
/// @return the movie
/// @throws InputError if the run cannot be read, or gnuplot or ffmpeg is missing
std::filesystem::path plot_movie(const PlotTask& task, Progress& progress);

/// Which pictures of a sweep are drawn, and where they go.
struct SweepPlotTask {
  SweepPaths paths;
  std::vector<std::string> columns;  ///< plain names; empty: all but the time
  std::optional<double> border;      ///< value of a column at which a border is shown; absent: see below
  std::filesystem::path curves;      ///< drawn over maps, see read_sweep_curves; empty: none
  std::filesystem::path output;      ///< folder
  PictureFormat format = PictureFormat::png;
};

/// Draws the table of a sweep: of one key, or of several that change together, OUTPUT/lines.FORMAT, each column against
/// the (first) key; of a grid of two keys OUTPUT/map_COLUMN.FORMAT for each column, a cell for each run; of a sweep
/// over a seed as well means over it, OUTPUT/lines.FORMAT and OUTPUT/lines.csv, see draw_sweep_means. Runs that were
/// refused have no point and a white cell; those that stopped are grey points and have a cross in their cell. A border
/// is a line at a value of the column, 1 of a ratio of lengths, 0 of a column of both signs; in a map between the cells
/// on whose sides the column is below and above it.
/// @return the pictures
/// @throws InputError if there is no table, if it has no such column, or of three keys and more
std::vector<std::filesystem::path> plot_sweep(const SweepPlotTask& task);

/// DIR/differences.dat: text, columns named in the first line, one block of lattice lines for every face.
std::filesystem::path differences_file(const std::filesystem::path& directory);

/// Draws DIR/differences.png, the differences of both methods on the membrane, from the data file that the
/// finite-element side left in DIR.
/// @return false if it left none
/// @throws InputError if gnuplot is missing or reports an error
bool draw_differences(const std::filesystem::path& directory);

}  // namespace vehd
