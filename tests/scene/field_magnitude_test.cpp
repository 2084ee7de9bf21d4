#include <boost/test/unit_test.hpp>

#include "bie/scene/effective_scene.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(field_magnitude)

namespace {

std::string with_field(const std::string& field) {
  return with_appended("[electric]\nconductivity_in = 1\nconductivity_out = 2\n" + field);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_field_has_it_along_its_direction) {
  const vehd::Scene scene = parsed(with_field("field = [3, 0, -4]\nfield_magnitude = 10\n"));
  BOOST_TEST((scene.electric->field == vehd::Triple{6.0, 0.0, -8.0}));
  BOOST_TEST((scene == parsed(with_field("field = [6, 0, -8]\n"))));
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(a_field_of_magnitude_0_keeps_its_direction) {
  const vehd::Scene scene = parsed(with_field("field = [3, 0, -4]\nfield_magnitude = 0\n"));
  BOOST_TEST((scene.electric->field == vehd::Triple{}));
  BOOST_TEST((scene.electric->direction == vehd::Triple{3.0, 0.0, -4.0}));
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  BOOST_TEST((parsed(with_field("field = [0, 0, 0]\n")).electric->direction == vehd::Triple{}));
}

BOOST_AUTO_TEST_CASE(it_may_be_set_over_a_field_with_units) {
  const vehd::Scene twice =
      vehd::parse_scene(si_scene(), "scene.toml", "/folder", {"electric.field_magnitude=0.2 kV/cm"});
  BOOST_TEST(twice.electric->field[2] == 2.0 * parsed(si_scene()).electric->field[2],
             boost::test_tools::tolerance(1e-14));
}

// The time μ/(εE²) follows from the field after scaling.
BOOST_AUTO_TEST_CASE(reference_scales_follow_from_it) {
  const std::string text =
      "[units]\n[shape]\nkind = \"prolate\"\nreduced_volume = 0.9\narea = \"1256 um^2\"\n"
      "[membrane]\ncapacitance = \"1 F/m^2\"\n[fluid]\nviscosity = \"1 mPa s\"\n"
      "[electric]\nconductivity_in = \"1 uS/cm\"\nconductivity_out = \"1 uS/cm\"\npermittivity = \"80 eps0\"\n"
      "[numerics]\ntolerance = 1e-3\nend_time = \"1 ms\"\n";
  const auto with = [&](const std::string& field) {
    std::string scene = text;
    return parsed(scene.insert(scene.find("conductivity_in"), field));
  };
  BOOST_TEST((with("field = [0, 0, 1]\nfield_magnitude = \"5 kV/cm\"\n").units ==
              with("field = [0, 0, \"5 kV/cm\"]\n").units));
}

BOOST_AUTO_TEST_CASE(without_a_direction_it_is_refused) {
  BOOST_TEST(message_of(with_field("field = [0, 0, 0]\nfield_magnitude = 1\n")) ==
             "scene.toml:11: \"field\" in [electric] is 0 beside \"field_magnitude\"; accepted: a direction");
  BOOST_TEST(message_of(with_field("field = [0, 0, 1]\nfield_magnitude = -1\n")).find("accepted: a number >= 0") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
