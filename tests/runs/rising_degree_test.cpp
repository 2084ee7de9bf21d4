#include <algorithm>
#include <boost/test/unit_test.hpp>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(rising_degree)

BOOST_AUTO_TEST_CASE(what_solves_leave_at_every_degree_is_no_reason_for_more) {
  // Between its pulses the membrane becomes compressed: what is wrong is expected to grow a hundred times, and what the
  // solves of a first-order step leave, the same at degree 26 and at 64, is more than the degrees may leave out.
  vehd::Scene scene = vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/two_step_pulse.toml"), 1e-7);
  scene.numerics.end_time = 0.36;
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  const double highest = std::ranges::max(history.column("order"));
  BOOST_TEST(highest <= 48.0);
  BOOST_TEST(highest >= 26.0);
}

BOOST_AUTO_TEST_SUITE_END()
