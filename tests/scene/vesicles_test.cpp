#include "bie/scene/vesicles.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <numbers>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/problem.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(vesicles)

namespace {

/// Lines 1 to 7 apply to all vesicles; the first vesicle begins on line 8.
const std::string kForAll =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 2.0]\n[numerics]\ndt = 0.1\nend_time = 1.0\norder = 8\n";

std::string at(const std::string& centre) { return "[[vesicle]]\nshape.centre = " + centre + "\n"; }

/// Sets every key that may differ between vesicles.
const std::string kDifferent =
    "[membrane]\nbending_modulus = 0.1\ncapacitance = 2.0\n[fluid]\nviscosity = 3.0\n[gravity]\nacceleration = [0, 0, "
    "-1]\n"
    "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
    "[numerics]\ndt = 0.1\nend_time = 1.0\norder = 8\n"
    "[[vesicle]]\nname = \"soft\"\n[vesicle.shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 2]\n"
    "[vesicle.fluid]\ndensity_difference = 0.5\n"
    "[[vesicle]]\nname = \"stiff\"\n[vesicle.shape]\nkind = \"prolate\"\nreduced_volume = 0.9\ncentre = [4, 0, 0]\n"
    "[vesicle.membrane]\nbending_modulus = 1.0\nconductance = 3.0\n[vesicle.fluid]\nviscosity_ratio = 5.0\n"
    "[vesicle.electric]\nconductivity_in = 0.5\n";

}  // namespace

BOOST_AUTO_TEST_CASE(inherit_the_keys_that_they_do_not_set) {
  const vehd::Scene scene = parsed(kDifferent);
  BOOST_TEST((vehd::vesicle_names(scene) == std::vector<std::string>{"soft", "stiff"}));
  const vehd::Scene soft = vehd::alone(scene, 0), stiff = vehd::alone(scene, 1);
  BOOST_TEST(soft.vesicles.empty());
  BOOST_TEST(*soft.membrane.bending_modulus == 0.1);
  BOOST_TEST(*stiff.membrane.bending_modulus == 1.0);
  for (const vehd::Scene& one : {soft, stiff}) {
    BOOST_TEST(one.membrane.capacitance == 2.0);
    BOOST_TEST(one.fluid.viscosity == 3.0);
  }
  BOOST_TEST(soft.electric->conductivity_in == 1.0);
  BOOST_TEST(stiff.electric->conductivity_in == 0.5);
  BOOST_TEST(soft.fluid.density_difference == 0.5);
  BOOST_TEST(stiff.fluid.density_difference == 0.0);
  const vehd::Model model = vehd::problem_of(scene).model;
  BOOST_REQUIRE(model.vesicles.size() == 2);
  BOOST_TEST(model.vesicles[0].viscosity_ratio == 1.0);
  BOOST_TEST(model.vesicles[1].viscosity_ratio == 5.0);
  BOOST_TEST(model.vesicles[0].effects.size() == 1);
  BOOST_TEST(model.vesicles[1].effects.size() == 0);
}

BOOST_AUTO_TEST_CASE(the_effective_scene_is_the_same_scene) {
  const vehd::Scene scene = parsed(kDifferent);
  const std::string text = vehd::effective_scene(scene);
  BOOST_TEST((parsed(text) == scene), text);
  BOOST_TEST(vehd::effective_scene(parsed(text)) == text);
}

BOOST_AUTO_TEST_CASE(keys_of_one_that_differ_are_named) {
  const vehd::Scene scene = parsed(kDifferent);
  std::string text = kDifferent;
  text.replace(text.find("viscosity_ratio = 5.0"), 21, "viscosity_ratio = 4.0");
  const auto keys = vehd::differing_keys(scene, parsed(text));
  BOOST_TEST((keys == std::vector<std::string>{"vesicle[1].fluid.viscosity_ratio"}));
  text.replace(text.find("stiff"), 5, "stout");
  BOOST_TEST((vehd::differing_keys(scene, parsed(text)) == std::vector<std::string>{"vesicle.name"}));
}

BOOST_AUTO_TEST_CASE(one_alone_is_a_scene_of_one) {
  const vehd::Scene scene = parsed(kForAll + at("[1, 0, 0]"));
  BOOST_TEST(scene.vesicles.empty());
  BOOST_TEST(scene.shape.centre[0] == 1.0);
}

BOOST_AUTO_TEST_CASE(are_refused_where_they_overlap) {
  const std::string accepted = "; accepted: each outside all others, by \"centre\" in [vesicle.shape]";
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + at("[1.5, 0, 0]")) ==
             "scene.toml:10: vesicle \"1\", about (1.5, 0, 0), overlaps vesicle \"0\", about (0, 0, 0)" + accepted);
  BOOST_TEST(message_of(kForAll + at("[1, 0, 0]") + at("[1, 0, 0]")) ==
             "scene.toml:10: vesicle \"1\", about (1, 0, 0), overlaps vesicle \"0\", about (1, 0, 0)" + accepted);
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + at("[0, 0, 0]\nshape.scale = 0.3")) ==
             "scene.toml:10: vesicle \"1\", about (0, 0, 0), is inside vesicle \"0\"" + accepted);
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]\nshape.scale = 0.3") + at("[0, 0, 0]")) ==
             "scene.toml:11: vesicle \"1\", about (0, 0, 0), has vesicle \"0\" inside" + accepted);
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + at("[2.001, 0, 0]")) ==
             "scene.toml:10: vesicle \"1\" is 0.00076 radii from vesicle \"0\"; accepted: at least 0.001");
  // A slightly larger gap is accepted.
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + at("[2.01, 0, 0]")).empty());
}

BOOST_AUTO_TEST_CASE(are_refused_with_unknown_or_common_keys) {
  BOOST_TEST(message_of(kForAll + "[[vesicle]]\nshap.centre = [0, 0, 0]\n") ==
             "scene.toml:9: unknown key \"shap\" in [[vesicle]]; did you mean \"shape\"?");
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + "[vesicle.fluid]\nviscosity = 2\n") ==
             "scene.toml:11: \"viscosity\" in [vesicle.fluid] is the same for all vesicles; accepted: in [fluid]");
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + "[vesicle.fluid]\nviscosity_ration = 2\n") ==
             "scene.toml:11: unknown key \"viscosity_ration\" in [fluid]; did you mean \"viscosity_ratio\"?");
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + "[vesicle.electric]\nconductivity_in = 2\n") ==
             "scene.toml:10: [vesicle.electric] without [electric]: there is no field that could act on it");
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]\nname = \"a\"") + at("[4, 0, 0]\nname = \"a\"")) ==
             "scene.toml:11: two vesicles have the name \"a\"");
  BOOST_TEST(message_of(kForAll + "[vesicle]\nname = \"a\"\n") ==
             "scene.toml:8: \"vesicle\" is a table; accepted: tables [[vesicle]]");
  std::string many = kForAll;
  for (int i = 0; i < 501; ++i) many += at("[0, 0, 0]");
  BOOST_TEST(message_of(many).ends_with(": 501 tables [[vesicle]]; accepted: at most 500"), message_of(many));
}

BOOST_AUTO_TEST_CASE(charge_alike_from_the_start) {
  const std::string electric = "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n";
  BOOST_TEST(message_of(kForAll + electric + at("[0, 0, 0]\nelectric.initial_Vm = \"steady\"") + at("[4, 0, 0]")) ==
             "scene.toml:15: vesicle \"1\" does not start with a steady V_m, but vesicle \"0\" does; accepted: "
             "\"initial_Vm\" steady for all vesicles or for none");
  BOOST_TEST(message_of(kForAll + electric + at("[0, 0, 0]") + at("[4, 0, 0]\nelectric.conductivity_in = 0")) ==
             "scene.toml:14: \"conductivity_in\" or \"conductivity_out\" of vesicle \"1\" is 0; accepted with several "
             "vesicles: > 0, as small as it has to be");
}

BOOST_AUTO_TEST_CASE(may_attract_or_repel_each_other) {
  const std::string pair = at("[0, 0, 0]") + at("[4, 0, 0]");
  const vehd::Scene scene = parsed(kForAll + "[contact]\nenergy = -0.2\nrange = 0.5\n" + pair);
  const vehd::Model model = vehd::problem_of(scene).model;
  BOOST_REQUIRE(model.contact.has_value());
  BOOST_TEST(model.contact->energy == -0.2);
  BOOST_TEST(model.contact->range == 0.5);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  const auto message = [&](const std::string& keys, const std::string& vesicles) {
    return message_of(kForAll + "[contact]\n" + keys + vesicles);
  };
  BOOST_TEST(message("energy = 0\nrange = 0.5\n", pair) ==
             "scene.toml:8: \"energy\" in [contact] is 0: it has no effect; accepted: any other value");
  BOOST_TEST(message("energy = 1\nrange = 0.5\n", "") ==
             "scene.toml:8: [contact] acts between vesicles, and there is one; accepted: with tables [[vesicle]]");
  BOOST_TEST(message("energy = 1\n", pair).starts_with("scene.toml:8: missing key \"range\" in [contact]"));
  BOOST_TEST(message("energy = 1\nrange = 0.01\n", pair) ==
             "scene.toml:10: \"range\" in [contact] is 0.0076 radii of vesicle \"0\"; accepted: at least 0.02");
}

// The scale follows from the first vesicle.
BOOST_AUTO_TEST_CASE(have_one_scale_of_length) {
  const std::string scene =
      "[units]\ntime = \"1 s\"\n[shape]\nkind = \"prolate\"\nreduced_volume = 0.9\n[numerics]\ndt = 0.1\nend_time = 1\n"
      "[fluid]\nviscosity = 1\n[[vesicle]]\nshape.area = \"400 um^2\"\n[[vesicle]]\nshape = {area = \"100 um^2\", "
      "centre = [\"40 um\", 0, "
      "0]}\n";
  const vehd::Scene read = parsed(scene);
  const double length = std::sqrt(400e-12 / (4.0 * std::numbers::pi));
  BOOST_TEST(*read.units->length == length, boost::test_tools::tolerance(1e-12));
  BOOST_TEST(*vehd::alone(read, 1).shape.area == 100e-12 / (length * length), boost::test_tools::tolerance(1e-12));
}

// Such large distances have no square, and coordinates retain no digits for the shape.
BOOST_AUTO_TEST_CASE(vesicles_beyond_the_digits_of_their_coordinates_are_refused) {
  for (const char* far : {"1e308", "-1e200", "1e40", "1e7"}) {
    const std::string centre = std::string("[0, ") + far + ", 0]";
    const std::string pair = message_of(kForAll + at("[0, 0, 0]") + at(centre));
    BOOST_TEST(pair.starts_with("scene.toml:11: \"centre\" in [shape] "), pair);
    BOOST_TEST(pair.find("; accepted: ") != std::string::npos, pair);
    std::string one = kForAll;
    one.insert(one.find("[numerics]"), "centre = " + centre + "\n");
    BOOST_TEST(message_of(one).starts_with("scene.toml:4: \"centre\" in [shape] "), message_of(one));
  }
  BOOST_TEST(message_of(kForAll + at("[0, 0, 0]") + at("[0, 1e6, 0]")) == "");
}

BOOST_AUTO_TEST_SUITE_END()
