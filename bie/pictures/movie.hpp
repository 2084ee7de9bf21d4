#pragma once

#include <filesystem>
#include <vector>

#include "bie/pictures/plots.hpp"
#include "bie/support/progress.hpp"

namespace vehd {

/// Writes an MP4 of so many pictures that plays in about ten seconds.
/// @param draw      called once for each of them; all have one size
/// @param file      replaced when the movie is complete
/// @param progress  is told of every picture
/// @throws InputError if ffmpeg is missing or reports an error
void write_movie(std::size_t n_frames, const FrameDrawer& draw, const std::filesystem::path& file, Progress& progress);

/// The movie of a run, OUTPUT/movie.mp4, of all snapshots or of many of them, evenly spread.
/// @return the movie
/// @throws InputError if the run cannot be read, or gnuplot or ffmpeg is missing
std::filesystem::path plot_movie(const PlotTask& task, Progress& progress);

}  // namespace vehd
