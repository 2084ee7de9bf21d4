#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/accuracy.hpp"
#include "bie/scene/reader.hpp"
#include "tests/support/recorded_history.hpp"

BOOST_AUTO_TEST_SUITE(tension_of_long_steps, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

namespace {

/// ∫λ dA over its largest magnitude after the field has stretched the vesicle for a share of the scene.
double tension(double tolerance, double share) {
  vehd::Scene scene =
      vehd::at_tolerance(vehd::read_scene(VEHD_SOURCE_DIR "/docs/scenes/ac_field_averaged.toml"), tolerance);
  scene.output.every.reset();
  scene.output.times = {share * scene.numerics.end_time};
  const vehd::HistoryTable history = vehd::testing::history_of(scene);
  const double largest = history.largest_magnitude("tension_integral");
  const std::size_t row = vehd::testing::row_at(history, share * history.column("time").back());
  return history.column("tension_integral")[row] / largest;
}

}  // namespace

BOOST_AUTO_TEST_CASE(errors_of_steps_are_magnified_by_a_membrane_that_becomes_taut) {
  // The field stretches the vesicle within a few steps, whose sweeps and quadrature have errors of a tenth of the
  // tolerance. The error of the tension is twenty times that.
  constexpr double share = 0.004;
  for (const double tolerance : {1e-5, 1e-6}) {
    for (const double later : {1.0, 2.0}) {
      const double wrong = std::abs(tension(tolerance, later * share) - tension(0.01 * tolerance, later * share));
      BOOST_TEST(wrong < 1.5 * tolerance, tolerance << ": " << wrong / tolerance);
    }
  }
}

BOOST_AUTO_TEST_SUITE_END()
