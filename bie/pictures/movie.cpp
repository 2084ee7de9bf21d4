#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "bie/pictures/plots.hpp"
#include "bie/pictures/shape_times.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/support/child_process.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr std::size_t most_frames = 500;
constexpr double seconds_of_movie = 10.0;
/// Slower movies stutter, faster ones hide details.
constexpr double least_frame_rate = 4.0, largest_frame_rate = 25.0;

/// Runs ffmpeg in a folder with names chosen by vehd: in other paths "%" would be a pattern and "x:" a protocol.
void run_ffmpeg(std::vector<std::string> arguments, const std::filesystem::path& folder) {
  const std::filesystem::path messages = folder / "messages";
  arguments.insert(arguments.begin(), {"ffmpeg", "-hide_banner", "-loglevel", "error", "-y"});
  const ChildEnd end = run_child({arguments, messages, folder});
  if (end.start_problem == ENOENT) {
    throw InputError("ffmpeg is not installed, which makes movies; on Debian it is the package ffmpeg");
  }
  if (end.start_problem != 0) {
    throw InputError(fmt::format("ffmpeg cannot be started: {}", std::strerror(end.start_problem)));
  }
  if (end.signal != 0 || end.exit_code != 0) {
    throw InputError(fmt::format("ffmpeg failed: {}", text_of_file(messages)));
  }
}

/// Writes an MP4 of n_frames pictures that plays in about ten seconds.
/// @param draw      called once for each picture; all have one size
/// @param file      replaced once the movie is complete
/// @param progress  updated at every picture
/// @throws InputError if ffmpeg is missing or reports an error
void write_movie(std::size_t n_frames, const FrameDrawer& draw, const std::filesystem::path& file, Progress& progress) {
  const TemporaryFolder folder("vehd-movie");
  // A missing ffmpeg is reported before minutes of drawing, not after.
  run_ffmpeg({"-version"}, folder.path());
  for (std::size_t i = 0; i < n_frames; ++i) {
    progress.update(static_cast<double>(i) / static_cast<double>(n_frames),
                    fmt::format("picture {} of {}", i + 1, n_frames));
    draw(i, folder.path() / fmt::format("{:06}.png", i));
  }
  progress.begin(1.0, "movie");
  const double rate =
      std::clamp(static_cast<double>(n_frames) / seconds_of_movie, least_frame_rate, largest_frame_rate);
  const char* movie = "movie.mp4";
  // Players require even sizes and this pixel format; with the index in front, a movie plays while it loads.
  run_ffmpeg({"-framerate", fmt::format("{:.4g}", rate), "-i", "%06d.png", "-vf",
              "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white", "-pix_fmt", "yuv420p", "-movflags", "+faststart", movie},
             folder.path());
  replace_file(file, text_of_file(folder.path() / movie));
}

}  // namespace

std::filesystem::path plot_movie(const PlotTask& task, Progress& progress) {
  ReadingNotes notes;
  const RunReader run = read_snapshots(task.paths.snapshots(), notes);
  const std::vector<std::size_t> snapshots = spread_evenly(run.times().size(), most_frames);
  make_directory(task.output);
  std::filesystem::path movie = task.output / "movie.mp4";
  write_movie(snapshots.size(), shape_frames(task, run, snapshots), movie, progress);
  return movie;
}

}  // namespace vehd
