#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/runs/verdict.hpp"
#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(rising_degree, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

BOOST_AUTO_TEST_CASE(what_solves_leave_at_every_degree_is_no_reason_for_more) {
  // What the solves of a first-order step leave is the same at degree 26 and at 64.
  vehd::Scene scene = vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/two_step_pulse.toml"), 1e-7);
  scene.numerics.end_time = 0.36;
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  const double highest = std::ranges::max(history.column("order"));
  BOOST_TEST(highest <= 48.0);
  BOOST_TEST(highest >= 26.0);
}

BOOST_AUTO_TEST_CASE(what_grows_a_million_times_is_reported_where_it_exceeds_the_tolerance) {
  // From the end of the first pulse to t = 1.2 disturbances of degree 25 grow 3e5 times and those of degree 40 more, so
  // degrees that are cut off before and errors of steps at degrees that are not needed become visible.
  const auto shortened = [](double tolerance) {
    vehd::Scene scene =
        vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/two_step_pulse.toml"), tolerance);
    scene.numerics.end_time = 1.25;
    return scene;
  };
  constexpr double tolerance = 1e-4;
  const vehd::Scene fine = shortened(0.01 * tolerance);
  const vehd::HistoryTable found = vehd::testing::history_of(shortened(tolerance)),
                           exact = vehd::testing::history_of(fine);
  for (const char* column : {"extent_x", "extent_z", "bending_energy_scaled"}) {
    const std::size_t last = found.n_rows() - 1;
    const double wrong = std::abs(found.column(column)[last] / exact.column(column)[exact.n_rows() - 1] - 1.0);
    BOOST_TEST(wrong < 3.0 * tolerance, column << " is wrong by " << wrong);
  }
  const std::string verdict = vehd::verdict_of(exact, vehd::trust_demands(fine));
  BOOST_TEST(verdict.find("compressed since time") != std::string::npos, verdict);
}

BOOST_AUTO_TEST_SUITE_END()
