#include <boost/test/unit_test.hpp>
#include <cmath>
#include <filesystem>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/model_of.hpp"
#include "bie/scene/problem.hpp"
#include "bie/scene/shapes/initial_shape.hpp"
#include "bie/scene/units.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(varying_scene)

namespace {

const std::string charged = "[electric]\nfield = [0, 0, 0]\nconductivity_in = 1\nconductivity_out = 2\n";
const std::string cap = "kind = \"cap\"\nangle_deg = 60\nwidth_deg = 30\ninside = 3\n";

bool refuses_varying(const std::string& keys, const std::string& what) {
  const std::string message = message_of(with_appended(keys));
  BOOST_TEST_MESSAGE(message);
  return message.find(what) != std::string::npos && message.starts_with("scene.toml:") &&
         message.find('\n') == std::string::npos;
}

double factor_at(const vehd::Vector& factor, double theta, double phi) {
  return vehd::evaluate_harmonics(factor, vehd::Vector{{theta}}, vehd::Vector{{phi}})(0, 0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(factors_follow_the_keys) {
  vehd::VaryingProperty varying;
  varying.base = 2.0;
  varying.modes = {{1, 0, 0.5}, {2, -1, 0.3}};
  const vehd::Vector harmonics = vehd::varying_factor(varying, 4);
  const double theta = 0.7, phi = 0.4, pi = std::acos(-1.0);
  // Re Y_1^0 and Im Y_2^1 of Eq. (17), written out by hand.
  const double expected = 2.0 + 0.5 * std::sqrt(3.0 / (4.0 * pi)) * std::cos(theta) +
                          0.3 * std::sqrt(15.0 / (8.0 * pi)) * std::sin(theta) * std::cos(theta) * std::sin(phi);
  BOOST_TEST(std::abs(factor_at(harmonics, theta, phi) - expected) < 1e-12);
  vehd::VaryingProperty round;
  round.kind = vehd::VariationKind::cap;
  round.axis = {2.0, 0.0, 0.0};
  round.angle_deg = 60.0;
  round.width_deg = 30.0;
  round.inside = 3.0;
  const vehd::Vector factor = vehd::varying_factor(round, 24);
  BOOST_TEST(std::abs(factor_at(factor, pi / 2.0, 0.0) - (3.0 - std::erfc(0.5 / (pi / 6.0 * std::sqrt(0.75))))) < 1e-5);
  BOOST_TEST(std::abs(factor_at(factor, pi / 2.0, pi / 3.0) - 2.0) < 1e-5);
  BOOST_TEST(std::abs(factor_at(factor, pi / 2.0, pi) - 1.0) < 1e-2);
  BOOST_TEST(vehd::varying_factor_truncation(round, 24) < 1e-5);
  BOOST_TEST(vehd::varying_factor_truncation(round, 6) > vehd::varying_factor_truncation(round, 12));
}

BOOST_AUTO_TEST_CASE(properties_reach_the_membrane) {
  const vehd::Scene scene = parsed(with_appended(
      "[membrane]\ncapacitance = 2\nconductance = 0.5\nbending_modulus = 0.1\nspontaneous_curvature = -0.4\n"
      "[membrane.varying_capacitance]\n" +
      cap +
      "[membrane.varying_conductance]\nkind = \"harmonics\"\nmodes = [{n = 1, m = 0, a = 0.5}]\n"
      "[membrane.varying_curvature]\n" +
      cap + "[membrane.pump]\ncurrent = 0.7\n" + cap + "[membrane.pump.waveform]\nkind = \"ac\"\nfrequency = 0.1\n" +
      charged));
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  const vehd::VesicleModel vesicle = vehd::model_of(scene).vesicles[0];
  BOOST_TEST(vesicle.has_varying_properties);
  BOOST_TEST_REQUIRE(vesicle.pump.has_value());
  BOOST_TEST(std::abs(vesicle.pump->at(5.0) + 1.0) < 1e-12);
  // Its force is the one with spatially varying coefficients.
  BOOST_TEST(vesicle.effects.empty());
  const vehd::Problem problem = vehd::problem_of(scene);
  BOOST_TEST(problem.symmetry.axisymmetric);
  const vehd::MembraneMaterial& material = problem.start[0].material;
  const double pi = std::acos(-1.0);
  BOOST_TEST(std::abs(factor_at(material.capacitance, pi / 3.0, 0.0) - 4.0) < 0.05);
  BOOST_TEST(std::abs(factor_at(material.pump_current, pi / 3.0, 0.0) - 1.4) < 0.02);
  BOOST_TEST(std::abs(factor_at(material.spontaneous_curvature, pi / 3.0, 0.0) + 0.8) < 0.02);
  BOOST_TEST(std::abs(factor_at(material.bending_modulus, 1.0, 0.0) - 0.1) < 1e-12);
}

BOOST_AUTO_TEST_CASE(places_take_part_in_the_symmetry) {
  const std::string pump = "[membrane.pump]\ncurrent = 0.7\n" + cap;
  const auto problem = [&](const std::string& keys) {
    return vehd::problem_of(
        parsed("[shape]\nkind = \"ellipsoid\"\naxes = [1, 1, 1]\n[numerics]\norder = 12\ndt = "
               "0.1\nend_time = 1\n" +
               charged + pump + keys));
  };
  // A sphere has no preferred axis: the axis of the cap is the axis of symmetry.
  const vehd::Problem tilted = problem("axis = [1, 2, 0.5]\n");
  BOOST_TEST(tilted.symmetry.axisymmetric);
  BOOST_TEST(std::abs(std::abs(tilted.frame.axes.col(2).dot(vehd::Vector3(1, 2, 0.5).normalized())) - 1.0) < 1e-9);
  // The cap is on one side, so no mirror exchanging its two ends remains.
  for (const vehd::Reflection& g : tilted.symmetry.reflections) BOOST_TEST(g.z > 0);
  const vehd::Problem two =
      problem("[membrane.varying_conductance]\naxis = [1, 0, 0]\n" + cap + "[membrane]\nconductance = 1\n");
  BOOST_TEST(!two.symmetry.axisymmetric);
}

BOOST_AUTO_TEST_CASE(a_pump_has_units) {
  const vehd::Scene scene = parsed(si_scene() + "[membrane.pump]\ncurrent = \"3 uA/cm^2\"\n" + cap);
  const auto scale = vehd::reference_scale(*scene.units, *vehd::find_dimension("current/area"));
  BOOST_TEST_REQUIRE(scale.has_value());
  BOOST_TEST(std::abs(scene.membrane.pump->current * *scale - 0.03) < 1e-12);
}

BOOST_AUTO_TEST_CASE(harmonics_come_from_a_file) {
  const TemporaryDirectory folder;
  const auto read = [&](const std::string& scene_text) {
    return vehd::parse_scene(scene_text, "scene.toml", std::filesystem::path(folder / "harmonics.txt").parent_path());
  };
  write_text(folder / "harmonics.txt", "# n m a\n1 0 0.5\n2, -1, 0.3\n");
  const std::string text =
      with_appended(charged + "[membrane.pump]\ncurrent = 2\nkind = \"file\"\npath = \"harmonics.txt\"\n");
  const vehd::Scene scene = read(text);
  BOOST_TEST((scene.membrane.pump->modes == std::vector<vehd::HarmonicMode>{{1, 0, 0.5}, {2, -1, 0.3}}));
  // The effective scene no longer needs the file.
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  write_text(folder / "harmonics.txt", "1 0 0.5\n1 2 0.3\n");
  try {
    read(text);
    BOOST_TEST(false, "taken");
  } catch (const std::exception& error) {
    BOOST_TEST(std::string(error.what()).find("harmonics.txt:2: is \"1 2 0.3\"") != std::string::npos, error.what());
  }
}

BOOST_AUTO_TEST_CASE(keys_without_effect_or_incompatible_with_places_are_refused) {
  const std::string pump = "[membrane.pump]\ncurrent = 1\n" + cap;
  BOOST_TEST(refuses_varying(pump, "[membrane.pump] has no effect without [electric]"));
  BOOST_TEST(refuses_varying(charged + "[membrane.pump]\n" + cap, "missing key \"current\""));
  BOOST_TEST(refuses_varying(charged + "[membrane.pump]\ncurrent = 0\n" + cap, "\"current\" in [membrane.pump] is 0"));
  BOOST_TEST(refuses_varying(charged + "[membrane.pump.waveform]\nkind = \"dc\"\n", "without [membrane.pump]"));
  BOOST_TEST(refuses_varying(charged + "initial_Vm = \"steady\"\n" + pump, "\"initial_Vm\""));
  BOOST_TEST(refuses_varying(charged + "[membrane.varying_conductance]\n" + cap, "\"conductance\" in [membrane] is 0"));
  BOOST_TEST(refuses_varying("[membrane.varying_bending]\n" + cap, "\"bending_modulus\" in [membrane] is 0"));
  BOOST_TEST(
      refuses_varying("[membrane]\nbending_modulus = 1\n[membrane.varying_bending]\nkind = \"cap\"\nangle_deg = "
                      "60\nwidth_deg = 30\ninside = -1\n",
                      "the factor in [membrane.varying_bending] falls to"));
  BOOST_TEST(refuses_varying(charged + "[membrane.pump]\ncurrent = 1\nkind = \"cap\"\nangle_deg = 60\nwidth_deg = 2\n"
                                       "inside = 3\n",
                             "\"width_deg\""));
  BOOST_TEST(refuses_varying(charged + "[membrane.pump]\ncurrent = 1\nkind = \"harmonics\"\nmodes = [{n = 50, m = 0, "
                                       "a = 1}]\n",
                             "at most the degree"));
  BOOST_TEST(refuses_varying(charged + pump + "base = 1\n", "belongs to"));
  const std::string field =
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
  BOOST_TEST(refuses_varying(field + "[electric.waveform]\nkind = \"ac\"\nfrequency = 50\naverage = true\n" + pump,
                             "\"average\""));
}

BOOST_AUTO_TEST_CASE(places_go_with_displacement_currents_averages_and_poration) {
  const std::string field =
      "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\npermittivity = 1\n";
  const std::string pump = "[membrane.pump]\ncurrent = 1\n" + cap;
  const std::string capacitance = "[membrane.varying_capacitance]\n" + cap;
  for (const std::string& keys :
       {field + "displacement_current = true\n" + pump,
        field + "[electric.waveform]\nkind = \"ac\"\nfrequency = 50\naverage = true\n" + capacitance,
        field + "displacement_current = true\n[poration]\nmodel = \"criterion\"\nthreshold_Vm = 1\n" + pump}) {
    BOOST_TEST(message_of(with_appended(keys)) == "");
  }
}

BOOST_AUTO_TEST_CASE(vesicles_have_places_of_their_own) {
  const vehd::Scene scene = parsed(with_appended(charged + "[[vesicle]]\n[vesicle.membrane.pump]\ncurrent = 1\n" + cap +
                                                 "[[vesicle]]\n[vesicle.shape]\ncentre = [6, 0, 0]\n"));
  BOOST_TEST(scene.vesicles[0].membrane.pump.has_value());
  BOOST_TEST(!scene.vesicles[1].membrane.pump.has_value());
  BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
  BOOST_TEST(vehd::varies_or_pumps(scene));
}

BOOST_AUTO_TEST_SUITE_END()
