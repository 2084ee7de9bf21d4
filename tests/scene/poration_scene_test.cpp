#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(poration_scene)

namespace {

const std::string in_a_field = "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n";

/// Whether [poration] with these keys after `before` is refused in one line containing `what`, at line 12 or later.
bool refuses(const std::string& before, const std::string& keys, const std::string& what) {
  const std::string message = message_of(with_appended(before + "[poration]\n" + keys));
  BOOST_TEST_MESSAGE(message);
  return message.find(what) != std::string::npos && message.starts_with("scene.toml:") &&
         message.find('\n') == std::string::npos;
}

}  // namespace

BOOST_AUTO_TEST_CASE(a_criterion_reaches_the_membrane) {
  const vehd::Scene scene =
      parsed(with_appended(in_a_field + "[poration]\nmodel = \"criterion\"\nthreshold_Vm = 1.5\nlysis_tension = 3\n"));
  const vehd::VesicleModel vesicle = vehd::model_of(scene).vesicles[0];
  BOOST_TEST_REQUIRE(vesicle.criterion.has_value());
  BOOST_TEST(*vesicle.criterion->potential == 1.5);
  BOOST_TEST(*vesicle.criterion->tension == 3.0);
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
}

BOOST_AUTO_TEST_CASE(thresholds_have_units) {
  const vehd::Scene scene =
      parsed(si_scene() + "[poration]\nmodel = \"criterion\"\nthreshold_Vm = \"1 V\"\nlysis_tension = \"8 mN/m\"\n");
  BOOST_TEST(*scene.poration->threshold_potential == 1e3);
  // 1 mPa s · 10 um/0.5 s is 2e-8 N/m.
  BOOST_TEST(std::abs(*scene.poration->lysis_tension - 4e5) < 1e-6);
}

BOOST_AUTO_TEST_CASE(missing_and_incompatible_keys_are_refused) {
  BOOST_TEST(refuses(in_a_field, "threshold_Vm = 1\n", "missing key \"model\" in [poration]"));
  BOOST_TEST(refuses(in_a_field, "model = \"criteria\"\n", "criterion"));
  BOOST_TEST(refuses(in_a_field, "model = \"criterion\"\n", "\"threshold_Vm\" or \"lysis_tension\""));
  BOOST_TEST(refuses(in_a_field, "model = \"criterion\"\nthreshold_Vm = -1\n", "> 0"));
  BOOST_TEST(refuses("", "model = \"criterion\"\nthreshold_Vm = 1\n", "without [electric]"));
  BOOST_TEST(refuses("[membrane]\ninextensible = false\n" + in_a_field, "model = \"criterion\"\nlysis_tension = 1\n",
                     "\"inextensible\""));
  BOOST_TEST(refuses(in_a_field + "[electric.waveform]\nkind = \"ac\"\nfrequency = 50\naverage = true\n",
                     "model = \"criterion\"\nthreshold_Vm = 1\n", "\"average\""));
}

BOOST_AUTO_TEST_CASE(the_tension_of_a_sphere_is_a_criterion_with_undulations_alone) {
  const auto message = [](const std::string& shape, const std::string& criterion) {
    return message_of("[shape]\n" + shape + "\n[numerics]\ndt = 0.1\nend_time = 1\ndegree = 6\n" + in_a_field +
                      "[poration]\nmodel = \"criterion\"\n" + criterion);
  };
  const std::string lysis = "lysis_tension = 1\n", potential = "threshold_Vm = 1\n";
  const std::string sphere = "kind = \"ellipsoid\"\naxes = [2, 2, 2]\ncentre = [1, 2, 3]";
  for (const std::string& round :
       {sphere, std::string("kind = \"radial\"\nbase = 3.0\nmodes = [{n = 0, m = 0, a = 0.1}]")}) {
    const std::string refused = message(round, potential + lysis);
    BOOST_TEST(refused.find("\"lysis_tension\" in [poration] of a sphere") != std::string::npos, refused);
  }
  BOOST_TEST(message(sphere, potential) == "");
  const std::string undulating = "[membrane]\nbending_modulus = 1\nundulations = true\nstretching_modulus = 1\n";
  BOOST_TEST(message(sphere, lysis + undulating) == "");
  BOOST_TEST(message("kind = \"ellipsoid\"\naxes = [2, 2, 2.01]", lysis) == "");
}

namespace {

const std::string porosity_keys =
    "model = \"porosity\"\nthreshold_Vm = 1\nporated_conductance = 100\nporation_time = 0.1\n";
const std::string pore_keys =
    "model = \"pores\"\ncreation_rate = 1\ncreation_Vm = 0.258\nrest_density = 1.5\npore_radius = 0.8\n"
    "membrane_thickness = 5\n";

}  // namespace

BOOST_AUTO_TEST_CASE(reactions_reach_the_membrane) {
  const vehd::Scene porosity =
      parsed(with_appended(in_a_field + "[poration]\n" + porosity_keys + "resealing_time = 2\nsteepness = 5\n"));
  const auto reaction = vehd::model_of(porosity).vesicles[0].reaction;
  BOOST_TEST_REQUIRE(reaction != nullptr);
  BOOST_TEST(!vehd::model_of(porosity).vesicles[0].criterion.has_value());
  BOOST_TEST(reaction->conductance(0.5).value == 50.0);
  BOOST_TEST(std::abs(reaction->rate(0.0, 1.0) - 5.0) < 1e-12);
  BOOST_TEST(std::abs(reaction->rate(1.0, 0.0) + 0.5) < 1e-3);
  BOOST_TEST((parsed(vehd::effective_scene(porosity)) == porosity));
  const vehd::Scene pores = parsed(with_appended(in_a_field + "[poration]\n" + pore_keys));
  // σ_p for σ_i = 1 and σ_e = 2 is 1/ln 2.
  const double pore = 2.0 * std::acos(-1.0) * 0.64 / std::log(2.0) / (0.8 * std::acos(-1.0) + 10.0);
  BOOST_TEST(std::abs(vehd::model_of(pores).vesicles[0].reaction->conductance(0.0).value / (1.5 * pore) - 1.0) < 1e-12);
  BOOST_TEST((parsed(vehd::effective_scene(pores)) == pores));
}

BOOST_AUTO_TEST_CASE(densities_and_rates_have_units) {
  const vehd::Scene scene = parsed(
      si_scene() +
      "[poration]\nmodel = \"pores\"\ncreation_rate = \"1e9 1/(m^2 s)\"\ncreation_Vm = \"258 mV\"\nrest_density = "
      "\"1.5e9 1/m^2\"\npore_radius = \"0.8 nm\"\nmembrane_thickness = \"5 nm\"\n");
  // In units of 10 um and 0.5 s.
  BOOST_TEST(std::abs(scene.poration->creation_rate - 0.05) < 1e-14);
  BOOST_TEST(std::abs(scene.poration->rest_density - 0.15) < 1e-14);
}

BOOST_AUTO_TEST_CASE(reactions_are_refused_where_they_have_no_sense) {
  const std::string porosity = porosity_keys + "resealing_time = 2\n";
  BOOST_TEST(refuses("", porosity, "without [electric]"));
  BOOST_TEST(refuses(in_a_field, porosity_keys, "\"resealing_time\""));
  BOOST_TEST(refuses(in_a_field, porosity_keys + "resealing_time = 0.1\n", "more than the \"poration_time\""));
  BOOST_TEST(refuses(in_a_field, porosity + "pore_radius = 1\n", "belongs to"));
  BOOST_TEST(refuses(in_a_field + "initial_Vm = \"steady\"\n", porosity, "\"initial_Vm\""));
  BOOST_TEST(refuses("[electric]\nfield = [0, 0, 1]\nconductivity_in = 0\nconductivity_out = 2\n", pore_keys,
                     "\"pore_conductivity\""));
}

BOOST_AUTO_TEST_CASE(every_model_goes_with_several_vesicles_and_displacement_currents) {
  const std::string two =
      "[[vesicle]]\n[[vesicle]]\n[vesicle.shape]\ncentre = [5, 0, 0]\n[vesicle.electric]\n"
      "conductivity_in = 3\n";
  const std::string relaxing = "permittivity = 1\ndisplacement_current = true\n";
  for (const std::string& keys :
       {porosity_keys + "resealing_time = 2\n", pore_keys, std::string("model = \"criterion\"\nthreshold_Vm = 1\n")}) {
    for (const std::string& currents : {std::string(), relaxing}) {
      BOOST_TEST(message_of(with_appended(in_a_field + currents + "[poration]\n" + keys + two)) == "");
    }
  }
  // Pores conduct according to the fluids of their vesicle.
  const vehd::Model model = vehd::model_of(parsed(with_appended(in_a_field + "[poration]\n" + pore_keys + two)));
  BOOST_TEST(model.vesicles[0].reaction->conductance(1.0).value != model.vesicles[1].reaction->conductance(1.0).value);
}

BOOST_AUTO_TEST_SUITE_END()
