#include "bie/scene/accuracy.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(accuracy)

namespace {

/// Scene with the given [numerics].
std::string with_numerics(const std::string& numerics) {
  return "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 2.0]\n[numerics]\nend_time = 10.0\n" + numerics;
}

}  // namespace

BOOST_AUTO_TEST_CASE(tolerance_sets_the_numerics_that_the_scene_leaves_open) {
  const vehd::Scene scene = parsed(with_numerics("tolerance = 1e-3\n"));
  BOOST_TEST(*scene.numerics.tolerance == 1e-3);
  BOOST_TEST(scene.numerics.order == 32);
  BOOST_TEST(scene.numerics.time_order == 5);
  const vehd::StepControl control = vehd::step_control_of(scene);
  BOOST_TEST(control.tolerance == 1e-3);
  BOOST_TEST(control.largest == 10.0);
  BOOST_TEST(vehd::settings_of(scene).flow_tolerance < 1e-5);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(scene_has_the_last_word) {
  const vehd::Scene scene = parsed(with_numerics("tolerance = 1e-6\norder = 20\ntime_order = 3\ndt = 0.5\n"));
  BOOST_TEST(scene.numerics.order == 20);
  BOOST_TEST(scene.numerics.time_order == 3);
  BOOST_TEST(vehd::step_control_of(scene).largest == 0.5);
}

BOOST_AUTO_TEST_CASE(steps_stay_well_below_a_period) {
  const vehd::Scene scene = parsed(
      with_numerics("tolerance = 1e-2\n[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n"
                    "[electric.waveform]\nkind = 'ac'\nfrequency = 2\n"));
  BOOST_TEST(vehd::step_control_of(scene).largest == 0.0625);
}

BOOST_AUTO_TEST_CASE(scene_at_a_tolerance_is_that_of_a_file_with_it) {
  const vehd::Scene fixed = parsed(with_numerics("dt = 0.5\norder = 12\n"));
  BOOST_TEST((vehd::at_tolerance(fixed, 1e-5) == parsed(with_numerics("tolerance = 1e-5\n"))));
  // A dt given together with a tolerance is an upper bound and is kept.
  const vehd::Scene bounded = parsed(with_numerics("tolerance = 1e-2\ndt = 0.5\n"));
  BOOST_TEST((vehd::at_tolerance(bounded, 1e-3) == parsed(with_numerics("tolerance = 1e-3\ndt = 0.5\n"))));
}

BOOST_AUTO_TEST_CASE(neither_step_nor_tolerance_is_an_error_as_is_a_tolerance_without_estimate) {
  BOOST_TEST(message_of(with_numerics("")) ==
             "scene.toml:4: missing key \"dt\" in [numerics] (largest time step); accepted: > 0, or a \"tolerance\"");
  BOOST_TEST(message_of(with_numerics("tolerance = 1e-3\ntime_order = 1\n")) ==
             "scene.toml:7: \"time_order\" in [numerics] is 1, which has no error estimate; accepted with a tolerance: "
             "2 to 5");
  BOOST_TEST(message_of(with_numerics("tolerance = 0.5\n")).find("scene.toml:6: \"tolerance\" in [numerics] is 0.5") ==
             0);
}

BOOST_AUTO_TEST_SUITE_END()
