#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(rising_degree, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

BOOST_AUTO_TEST_CASE(residuals_of_solves_do_not_raise_the_degree) {
  // Between its pulses the membrane becomes compressed: errors are expected to grow a hundred times, and the residual
  // of the solves of a first-order step, the same at degree 26 and at 64, exceeds the permitted truncation error.
  vehd::Scene scene = vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/two_step_pulse.toml"), 1e-7);
  scene.numerics.end_time = 0.36;
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  const double highest = std::ranges::max(history.column("order"));
  BOOST_TEST(highest <= 48.0);
  BOOST_TEST(highest >= 26.0);
}

BOOST_AUTO_TEST_CASE(a_disturbance_that_grows_a_million_times_is_as_exact_as_the_tolerance) {
  // From the end of the first pulse to t = 1.2 disturbances of degree 25 grow 3e5 times and those of degree 40 more, so
  // earlier truncation and errors of steps at degrees that are not needed become visible.
  const auto history = [](double tolerance) {
    vehd::Scene scene =
        vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/two_step_pulse.toml"), tolerance);
    scene.numerics.end_time = 1.25;
    return vehd::testing::history_of(scene);
  };
  constexpr double tolerance = 1e-6;
  const vehd::HistoryTable found = history(tolerance), exact = history(0.1 * tolerance);
  for (const char* column : {"extent_x", "extent_z", "bending_energy_scaled"}) {
    const std::size_t last = found.n_rows() - 1;
    const double wrong = std::abs(found.column(column)[last] / exact.column(column)[exact.n_rows() - 1] - 1.0);
    BOOST_TEST(wrong < 3.0 * tolerance, column << " is wrong by " << wrong);
  }
}

BOOST_AUTO_TEST_SUITE_END()
