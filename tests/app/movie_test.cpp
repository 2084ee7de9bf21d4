#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/reference_run.hpp"

namespace {

/// A run with four snapshots.
struct RunWithSnapshots : FinishedRun {
  RunWithSnapshots() : FinishedRun(quick_scene("1.5")) {}
};

}  // namespace

BOOST_AUTO_TEST_SUITE(movie, *boost::unit_test::label("once"))

BOOST_FIXTURE_TEST_CASE(has_a_picture_for_each_snapshot, RunWithSnapshots) {
  if (run_command({"sh", "-c", "command -v ffmpeg && command -v ffprobe"}).exit_code != 0) {
    BOOST_TEST_MESSAGE("skipped: ffmpeg (Debian package ffmpeg) is missing");
    return;
  }
  const ProgramResult result = run_vehd({"plot", output, "--movie", "--json", directory / "plot.json"});
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  const auto movie = json_of(directory / "plot.json")["movie"].get<std::string>();
  BOOST_TEST(movie == output + "/plots/movie.mp4");
  const ProgramResult probe =
      run_command({"ffprobe", "-v", "error", "-count_frames", "-show_streams", "-of", "json", movie});
  BOOST_TEST_REQUIRE(probe.exit_code == 0, probe.errors);
  const nlohmann::json stream = nlohmann::json::parse(probe.output)["streams"][0];
  BOOST_TEST(stream["nb_read_frames"] == "4");
  BOOST_TEST(stream["pix_fmt"] == "yuv420p");
  BOOST_TEST(stream["width"].get<int>() > 400);

  // The pictures differ: the first frame is not the last.
  const auto checksum = [&](const std::string& frame) {
    return run_command(
               {"ffmpeg", "-v", "error", "-i", movie, "-vf", "select=eq(n\\," + frame + ")", "-f", "framemd5", "-"})
        .output;
  };
  BOOST_TEST(checksum("0").size() > 100);
  BOOST_TEST(checksum("0").substr(checksum("0").rfind(',')) != checksum("3").substr(checksum("3").rfind(',')));
}

BOOST_FIXTURE_TEST_CASE(needs_ffmpeg_and_says_so, RunWithSnapshots) {
  const std::string programs = directory / "programs";
  std::filesystem::create_directories(programs);
  const ProgramResult gnuplot = run_command({"sh", "-c", "command -v gnuplot"});
  if (gnuplot.exit_code != 0) return;
  std::filesystem::create_symlink(gnuplot.output.substr(0, gnuplot.output.find('\n')), programs + "/gnuplot");
  const ProgramResult result =
      run_command({"sh", "-c", "PATH='" + programs + "' exec '" VEHD_PROGRAM "' plot '" + output + "' --movie"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == "ffmpeg is not installed, which makes movies; on Debian it is the package ffmpeg\n");
  BOOST_TEST(!std::filesystem::exists(output + "/plots/movie.mp4"));
}

BOOST_AUTO_TEST_SUITE_END()
