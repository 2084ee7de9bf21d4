#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "bie/files/snapshot_choice.hpp"
#include "bie/runs/run_directory.hpp"

namespace vehd {

/// Which pictures are drawn, and where they go.
struct PlotTask {
  RunPaths paths;
  std::vector<double> times;     ///< of the shapes; empty: evenly spread
  std::filesystem::path output;  ///< directory for the pictures
  int shape_width = 520;         ///< pixels of one shape, at most
};

/// Draws all pictures of a run through gnuplot; needs no display.
/// @return the pictures
/// @throws InputError if the run cannot be read or gnuplot is missing
std::vector<std::filesystem::path> plot_run(const PlotTask& task);

/// The snapshots of the row of shapes, each once; those of given times with a note where they have another time.
/// @throws InputError if there are too many times or one of them is none of the run
std::vector<SnapshotChoice> shapes_to_plot(const PlotTask& task, const RunReader& run);

/// One row of shapes in perspective, coloured by V_m, or by tension without one.
void plot_shapes(const PlotTask& task, const std::filesystem::path& picture);

/// Draws the picture of a snapshot to a PNG file.
using FrameDrawer = std::function<void(std::size_t snapshot, const std::filesystem::path& picture)>;

/// Pictures of single shapes as those of `plot_shapes`, all at one scale and with the same colours.
/// @param run        must outlive what is returned
/// @param snapshots  that will be drawn
FrameDrawer shape_frames(const PlotTask& task, const RunReader& run, const std::vector<std::size_t>& snapshots);

/// Energy and tension, V_m and charge at the north pole (or extents), inclination in flow, against time.
void plot_history(const PlotTask& task, const std::filesystem::path& picture);

}  // namespace vehd
