#include <boost/test/unit_test.hpp>
#include <regex>

#include "tests/app/program.hpp"

BOOST_AUTO_TEST_SUITE(read_run, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(python_draws_figure_4_from_the_files_alone) {
  const std::string python = python_with("h5py, numpy, matplotlib");
  if (python.empty()) {
    BOOST_TEST_MESSAGE(
        "skipped: h5py, numpy or matplotlib (Debian packages python3-h5py, python3-numpy, python3-matplotlib) is "
        "missing");
    return;
  }
  const TemporaryDirectory directory;
  const std::string picture = directory / "figure4.png";
  std::vector<std::string> command{python, VEHD_SOURCE_DIR "/docs/examples/read_run.py", "-o", picture};
  for (const std::string name : {"figure2", "figure3"}) {
    const std::string scene = directory / (name + ".toml");
    write_text(scene, shortened_scene(file_text(VEHD_SOURCE_DIR "/docs/scenes/" + name + ".toml")));
    const ProgramResult run = run_vehd({"run", scene, "-o", directory / name, "--no-plot"});
    BOOST_TEST_REQUIRE(run.exit_code == 0, run.errors);
    command.push_back(directory / name);
  }
  const ProgramResult result = run_command(command);
  BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  BOOST_TEST(file_text(picture).starts_with("\x89PNG"));

  // The energy computed from the fields agrees with that of the history; the soft membrane comes first.
  const std::regex line("κ_B = (0\\.\\d+): energy ([0-9.]+) at time 0.3; history and snapshots agree to ([0-9e-]+)\n");
  std::smatch match;
  std::string text = result.output;
  for (const char* modulus : {"0.01", "0.1"}) {
    BOOST_TEST_REQUIRE(std::regex_search(text, match, line), result.output);
    BOOST_TEST(match[1] == modulus);
    BOOST_TEST(std::stod(match[2]) > 12.57);
    // At degree 6 the quadrature on the grid of that degree is less accurate than that of the history.
    BOOST_TEST(std::stod(match[3]) < 1e-4);
    text = match.suffix();
  }
}

BOOST_AUTO_TEST_SUITE_END()
