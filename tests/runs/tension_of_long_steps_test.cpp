#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(tension_of_long_steps)

BOOST_AUTO_TEST_CASE(what_the_quadrature_leaves_is_magnified_by_a_membrane_that_becomes_taut) {
  // The field draws the vesicle within two steps, whose quadrature is wrong by a tenth of the tolerance. The tension is
  // wrong by twenty times that.
  constexpr double tolerance = 1e-6, share = 0.004;
  const auto tension = [](double exact_to) {
    vehd::Scene scene =
        vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/ac_field_averaged.toml"), exact_to);
    scene.output.every.reset();
    scene.output.times = {share * scene.numerics.end_time};
    const vehd::HistoryTable history = vehd::testing::history_of(scene);
    const double largest = history.largest_magnitude("tension_integral");
    const std::size_t row = vehd::testing::row_at(history, share * history.column("time").back());
    return history.column("tension_integral")[row] / largest;
  };
  const double wrong = std::abs(tension(tolerance) - tension(0.01 * tolerance));
  BOOST_TEST(wrong < 1.5 * tolerance, wrong);
}

BOOST_AUTO_TEST_SUITE_END()
