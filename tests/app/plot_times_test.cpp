#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bie/comparison/frozen_state.hpp"
#include "bie/runs/history.hpp"
#include "bie/support/errors.hpp"
#include "tests/app/reference_run.hpp"

namespace {

/// Snapshots at 0, 0.5, 1 and 1.25.
struct ShortRun : FinishedRun {
  ShortRun() : FinishedRun(quick_scene("1.25")) {}
  [[nodiscard]] std::string file() const { return output + "/run.h5"; }
  [[nodiscard]] ProgramResult plot(const std::string& times) const {
    return run_vehd({"plot", output, "--times", times, "--json", directory / "plot.json"});
  }
  [[nodiscard]] std::vector<double> times() const {
    return json_of(directory / "plot.json").at("times").get<std::vector<double>>();
  }
  [[nodiscard]] std::string note(const std::string& asked, const std::string& taken) const {
    return file() + ": no snapshot at time " + asked + "; taken: the nearest, at " + taken + "\n";
  }
  [[nodiscard]] std::string refusal(const std::string& asked, const std::string& nearest) const {
    return file() + ": no snapshot near time " + asked + "; there are 4 from 0 to 1.25, the nearest at " + nearest;
  }
};

/// Snapshots at 0, 50, 100 and 125 us; 1 of the scene is 10 us, the history has ms.
struct ShortSiRun : FinishedRun {
  ShortSiRun()
      : FinishedRun(
            "[units]\nlength = \"10 um\"\ntime = \"10 us\"\n"
            "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n[membrane]\nbending_modulus = 1e-4\n"
            "[fluid]\nviscosity = 1\n[numerics]\norder = 6\ndt = 2.5\nend_time = 12.5\n[output]\nevery = 5.0\n") {}
  [[nodiscard]] ProgramResult plot(const std::string& times) const {
    return run_vehd(
        {"plot", output, "--times", times, "-o", directory / "shapes.svg", "--json", directory / "plot.json"});
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(plot_times, *boost::unit_test::label("once"))

BOOST_FIXTURE_TEST_CASE(pictures_say_which_times_they_have_taken, ShortRun) {
  const ProgramResult exact = plot("0,0.5,1.25");
  BOOST_TEST(exact.exit_code == 0, exact.errors);
  BOOST_TEST(exact.errors.empty(), exact.errors);
  BOOST_TEST(times() == (std::vector<double>{0.0, 0.5, 1.25}), boost::test_tools::per_element());

  const ProgramResult near = plot("0.1,0.5,0.7,1.3");
  BOOST_TEST(near.exit_code == 0, near.errors);
  BOOST_TEST(near.errors == note("0.1", "0") + note("0.7", "0.5") + note("1.3", "1.25"));
  BOOST_TEST(times() == (std::vector<double>{0.0, 0.5, 1.25}), boost::test_tools::per_element());

  const ProgramResult spread = run_vehd({"plot", output});
  BOOST_TEST(spread.exit_code == 0, spread.errors);
  BOOST_TEST(spread.errors.empty(), spread.errors);
}

BOOST_FIXTURE_TEST_CASE(times_outside_the_run_are_refused, ShortRun) {
  for (const auto& [asked, nearest] : {std::pair{"5", "1.25"}, {"-1", "0"}, {"1.4", "1.25"}}) {
    const ProgramResult result = plot(std::string("0,") + asked);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors == refusal(asked, nearest) + "\n");
    BOOST_TEST(!std::filesystem::exists(output + "/plots/shapes.png"));
  }
  for (const char* asked : {"nan", "five", "5 kV"}) {
    const ProgramResult result = plot(std::string("0,") + asked);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(
        result.errors.find(std::string("\"") + asked + "\" is not a time; accepted: a number") != std::string::npos,
        result.errors);
  }
  const ProgramResult unit = plot("0,1 ms");
  BOOST_TEST(unit.exit_code == 1);
  BOOST_TEST(unit.errors ==
             file() + ": the time \"1 ms\" has a unit, but the scene has no unit of time; accepted: a number\n");
}

// Regression: a number was taken in units of the scene, 10 us, although everything that a user reads is in ms.
BOOST_FIXTURE_TEST_CASE(times_of_a_run_in_si_are_those_that_it_shows, ShortSiRun) {
  BOOST_TEST(vehd::HistoryTable(output + "/history.csv").header("time") == "time [ms]");
  for (const char* times : {"0,0.05,0.125", "0 s, 0.05 ms, 125 µs", "0.0,50us,1.25e-4 s"}) {
    const ProgramResult result = plot(times);
    BOOST_TEST(result.exit_code == 0, result.errors);
    BOOST_TEST(result.errors == "");
    const auto json = json_of(directory / "plot.json");
    BOOST_TEST(json.at("time_unit") == "ms");
    const auto drawn = json.at("times").get<std::vector<double>>();
    const std::vector<double> expected = {0.0, 0.05, 0.125};
    BOOST_TEST(drawn == expected, boost::test_tools::tolerance(1e-12) << boost::test_tools::per_element());
  }
  const std::string run = output + "/run.h5";
  const ProgramResult near = plot("0.045");
  BOOST_TEST(near.errors == run + ": no snapshot at time 0.045 ms; taken: the nearest, at 0.05 ms\n");
  const ProgramResult far = plot("1 ms");
  BOOST_TEST(far.exit_code == 1);
  BOOST_TEST(far.errors ==
             run + ": no snapshot near time 1 ms; there are 4 from 0 ms to 0.125 ms, the nearest at 0.125 ms\n");
}

BOOST_FIXTURE_TEST_CASE(frozen_states_of_a_run_in_si_take_the_same_times, ShortSiRun) {
  const std::string run = output + "/run.h5";
  for (const char* time : {"0.05", "50 us", "0.05 ms"}) {
    BOOST_TEST(vehd::read_frozen_state({run, {}}, time).state.time == 5.0, boost::test_tools::tolerance(1e-12));
    BOOST_TEST(vehd::read_frozen_shape(run, time).notes.empty());
  }
  // A file without its history does not say in which unit its times were shown.
  const std::string lone = directory / "lone.h5";
  std::filesystem::copy_file(run, lone);
  BOOST_TEST(vehd::read_frozen_state({lone, {}}, "50 us").state.time == 5.0, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(vehd::read_frozen_state({lone, {}}, "0").state.time == 0.0);
  BOOST_CHECK_EXCEPTION((void)vehd::read_frozen_shape(lone, "50"), vehd::InputError, [&](const auto& error) {
    return error.what() == lone +
                               ": the time 50 has no unit, and no history.csv beside the run says which one its times "
                               "have; accepted: as in \"50 ms\"";
  });
  // A scene has only its start, in any unit.
  BOOST_TEST(vehd::read_frozen_shape(scene, "0 ms").notes.empty());
  BOOST_CHECK_THROW((void)vehd::read_frozen_shape(scene, "50 us"), vehd::InputError);
}

// If a run shows numbers of the scene, a time without a unit is such a number.
BOOST_AUTO_TEST_CASE(times_of_a_run_that_shows_numbers_of_the_scene_are_such) {
  const FinishedRun run(quick_scene_with_units("time = \"10 us\"\n", "0.5") + "units = \"dimensionless\"\n");
  const std::string file = run.output + "/run.h5";
  BOOST_TEST(vehd::read_frozen_shape(file, "0.5").notes.empty());
  BOOST_TEST(vehd::read_frozen_shape(file, "5 us").notes.empty());
}

BOOST_FIXTURE_TEST_CASE(frozen_states_take_the_same_times, ShortRun) {
  const auto both = [&](const std::optional<std::string>& time) {
    const vehd::FrozenState state = vehd::read_frozen_state({file(), {}}, time);
    const vehd::FrozenShape shape = vehd::read_frozen_shape(file(), time);
    BOOST_TEST_REQUIRE(shape.positions.size() == 1);
    BOOST_TEST((shape.positions.front() == state.state.vesicles[0].position));
    BOOST_TEST(shape.notes == state.notes, boost::test_tools::per_element());
    return std::pair{state.state.time, state.notes.empty() ? "" : state.notes.front() + "\n"};
  };
  BOOST_TEST((both(std::nullopt) == std::pair{1.25, std::string()}));
  BOOST_TEST((both("0.5") == std::pair{0.5, std::string()}));
  BOOST_TEST((both("0.7") == std::pair{0.5, note("0.7", "0.5")}));
  const auto is_refused = [&](const vehd::InputError& error) { return error.what() == refusal("5", "1.25"); };
  BOOST_CHECK_EXCEPTION((void)vehd::read_frozen_state({file(), {}}, "5"), vehd::InputError, is_refused);
  BOOST_CHECK_EXCEPTION((void)vehd::read_frozen_shape(file(), "5"), vehd::InputError, is_refused);
}

BOOST_AUTO_TEST_SUITE_END()
