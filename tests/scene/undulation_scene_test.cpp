#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(undulation_scene)

namespace {

/// @param membrane  lines of [membrane], which begins on line 8
std::string problem(const std::string& membrane, const std::string& more = {}) {
  return message_of(with_appended("[membrane]\n" + membrane + more));
}

const std::string on = "undulations = true\nbending_modulus = 1\n";

}  // namespace

BOOST_AUTO_TEST_CASE(keys_of_undulations_need_them) {
  for (const char* key : {"temperature", "stretching_modulus", "reference_tension", "rest_area"}) {
    BOOST_TEST(problem(fmt::format("{} = 1\n", key)) ==
               fmt::format("scene.toml:9: \"{}\" in [membrane] has no effect without \"undulations\"", key));
  }
}

BOOST_AUTO_TEST_CASE(one_of_several_vesicles_may_have_none) {
  const std::string common = on + "temperature = 0.1\n";
  const std::string other = "[vesicle.shape]\ncentre = [9, 0, 0]\n";
  BOOST_TEST(problem(common, "[[vesicle]]\n[[vesicle]]\n" + other + "[vesicle.membrane]\nundulations = false\n") == "");
  BOOST_TEST(problem(common, "[[vesicle]]\n[vesicle.membrane]\nundulations = false\n[[vesicle]]\n" + other +
                                 "[vesicle.membrane]\nundulations = false\n") != "");
}

BOOST_AUTO_TEST_CASE(undulations_need_a_tension_and_the_keys_of_their_size) {
  const std::string start = "scene.toml:9: \"undulations\" in [membrane] ";
  BOOST_TEST(problem(on) == start + "needs \"temperature\", \"stretching_modulus\" or both");
  BOOST_TEST(problem(on + "temperature = 0.1\n") == "");
  BOOST_TEST(problem(on + "stretching_modulus = 10\n") == "");
  BOOST_TEST(problem("undulations = true\ntemperature = 0.1\n") ==
             start + "needs \"bending_modulus\", which sets how much they store");
  BOOST_TEST(problem(on + "temperature = 0.1\ninextensible = false\n") ==
             start + "has no effect without a tension; accepted: \"inextensible\" and \"mobile\" true");
  BOOST_TEST(problem(on + "temperature = 0.1\n",
                     "[membrane.varying_bending]\nkind = \"cap\"\nangle_deg = 60\nwidth_deg = 40\ninside = 2\n") ==
             start + "needs a uniform bending modulus; accepted: no [membrane.varying_bending]");
}

BOOST_AUTO_TEST_CASE(the_area_at_rest_is_given_once) {
  BOOST_TEST(problem(on + "temperature = 0.1\nreference_tension = 1\nrest_area = 20\n") ==
             "scene.toml:13: \"rest_area\" in [membrane] sets the area at rest, and so does \"reference_tension\"; "
             "accepted: one of them");
}

// For κ_c = 1/2 and A = 21.48 the logarithm ends at −10 κ_c/A_0.
BOOST_AUTO_TEST_CASE(a_membrane_that_buckles_is_refused) {
  const std::string text = on + "temperature = 0.1\n";
  BOOST_TEST(problem(text + "reference_tension = -0.2\n") == "");
  BOOST_TEST(problem(text + "reference_tension = -0.25\n") ==
             "scene.toml:12: \"reference_tension\" in [membrane] is -0.25, but a membrane of this area buckles at "
             "-0.232792; accepted: more");
}

BOOST_AUTO_TEST_CASE(tensions_are_said_in_the_units_of_the_file) {
  std::string text = si_scene();
  text.insert(text.find("[fluid]"), "undulations = true\ntemperature = \"298 K\"\nreference_tension = \"-1 mN/m\"\n");
  BOOST_TEST(message_of(text).find(
                 "\"reference_tension\" in [membrane] is -1 mN/m, but a membrane of this area buckles at -") !=
             std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
