#include <boost/test/unit_test.hpp>
#include <numeric>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(sweeps_that_contract)

BOOST_AUTO_TEST_CASE(no_step_is_given_up_that_further_sweeps_would_make_exact) {
  // Each sweep reduces the error of V_m to a hundredth and, a sweep later, that of the tension.
  vehd::Scene scene = vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/ac_field.toml"), 1e-6);
  scene.numerics.end_time = 0.06;
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  const std::vector<double>& rejected = history.column("rejected");
  const double n_rejected = std::accumulate(rejected.begin(), rejected.end(), 0.0);
  const double n_steps = static_cast<double>(history.n_rows());
  BOOST_TEST(n_rejected < 0.25 * n_steps, n_rejected << " rejected before " << n_steps);
}

BOOST_AUTO_TEST_SUITE_END()
