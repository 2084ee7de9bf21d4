#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

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

}  // namespace vehd
