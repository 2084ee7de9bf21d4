#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bie/comparison/frozen_state.hpp"
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
  for (const auto& [asked, nearest] : {std::pair{"5", "1.25"}, {"-1", "0"}, {"1.4", "1.25"}, {"nan", "0"}}) {
    const ProgramResult result = plot(std::string("0,") + asked);
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors == refusal(asked, nearest) + "\n");
    BOOST_TEST(!std::filesystem::exists(output + "/plots/shapes.png"));
  }
}

BOOST_FIXTURE_TEST_CASE(frozen_states_take_the_same_times, ShortRun) {
  const auto both = [&](std::optional<double> time) {
    const vehd::FrozenState state = vehd::read_frozen_state({file(), {}}, time);
    const vehd::FrozenShape shape = vehd::read_frozen_shape(file(), time);
    BOOST_TEST((shape.position == state.state.vesicles[0].position));
    BOOST_TEST(shape.note == state.note);
    return std::pair{state.state.time, state.note.empty() ? "" : state.note + "\n"};
  };
  BOOST_TEST((both(std::nullopt) == std::pair{1.25, std::string()}));
  BOOST_TEST((both(0.5) == std::pair{0.5, std::string()}));
  BOOST_TEST((both(0.7) == std::pair{0.5, note("0.7", "0.5")}));
  const auto is_refused = [&](const vehd::InputError& error) { return error.what() == refusal("5", "1.25"); };
  BOOST_CHECK_EXCEPTION((void)vehd::read_frozen_state({file(), {}}, 5.0), vehd::InputError, is_refused);
  BOOST_CHECK_EXCEPTION((void)vehd::read_frozen_shape(file(), 5.0), vehd::InputError, is_refused);
}

BOOST_AUTO_TEST_SUITE_END()
