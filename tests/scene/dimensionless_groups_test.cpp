#include "bie/scene/dimensionless_groups.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(dimensionless_groups)

namespace {

std::map<std::string, vehd::DimensionlessGroup> groups_of(const vehd::Scene& scene) {
  std::map<std::string, vehd::DimensionlessGroup> groups;
  for (const auto& group : vehd::dimensionless_groups(scene)) groups[std::string(group.symbol)] = group;
  return groups;
}

}  // namespace

BOOST_AUTO_TEST_CASE(have_the_values_worked_out_in_si) {
  auto groups = groups_of(parsed(si_scene()));
  const auto tolerance = boost::test_tools::tolerance(1e-9);
  const double radius = 1e-5, bending = 2e-20, viscosity = 1e-3, rate = 2.0, stress = 80 * 8.8541878188e-12 * 1e8;
  const double series = 2.0 * 0.01 * 0.02 / (0.01 + 0.04);
  BOOST_TEST(groups["v"].value == 0.9, tolerance);
  BOOST_TEST(groups["Δ"].value == 4.0 * std::numbers::pi * (std::pow(0.9, -2.0 / 3.0) - 1.0), tolerance);
  BOOST_TEST(groups["a"].value * 1e-5 == radius, tolerance);
  BOOST_TEST(groups["t_κ"].value * 0.5 == viscosity * 1e-15 / bending, tolerance);
  BOOST_TEST(groups["χ"].value == viscosity * rate * 1e-15 / bending, tolerance);
  BOOST_TEST(groups["R"].value == 0.5, tolerance);
  BOOST_TEST(groups["g"].value == 100.0 * radius / 0.02, tolerance);
  BOOST_TEST(groups["t_m"].value * 0.5 == 0.01 / (100.0 + series / radius), tolerance);
  BOOST_TEST(groups["t_el"].value * 0.5 == viscosity / stress, tolerance);
  BOOST_TEST(groups["Ca"].value == stress / bending * 0.9 * 1e-15, tolerance);
  BOOST_TEST(groups["Mn"].value == viscosity * rate / stress, tolerance);
  BOOST_TEST(groups["t_γ"].value * 0.5 == 1.0 / rate, tolerance);
  BOOST_TEST(groups["t_MW"].value * 0.5 == 3.0 * 80 * 8.8541878188e-12 / (0.01 + 0.04), tolerance);
}

BOOST_AUTO_TEST_CASE(do_not_depend_on_the_reference_scales) {
  std::string other = si_scene();
  for (const auto& [from, to] : {std::pair{"10 um", "3 um"}, {"500 ms", "7 us"}, {"= \"1 mV", "= \"2 V"}}) {
    other.replace(other.find(from), std::string(from).size(), to);
  }
  const auto a = groups_of(parsed(si_scene())), b = groups_of(parsed(other));
  BOOST_TEST(a.size() == b.size());
  for (const auto& [symbol, group] : a) {
    if (group.unit == "1") BOOST_TEST(b.at(symbol).value == group.value, boost::test_tools::tolerance(1e-12));
  }
}

BOOST_AUTO_TEST_CASE(charging_time_is_that_of_a_conducting_sphere) {
  // C_m V̇ = −G_m V + κ(3E/2 − V), κ = 2σ_iσ_e/(σ_i + 2σ_e)
  auto groups = groups_of(
      parsed("[shape]\nkind='ellipsoid'\naxes=[1,1,1]\n[membrane]\ncapacitance=3\nconductance=0.5\n[electric]\n"
             "field=[0,0,1]\nconductivity_in=1\nconductivity_out=2\n[numerics]\ndt=1\nend_time=1\n"));
  BOOST_TEST(groups["t_m"].value == 3.0 / (0.5 + 0.8), boost::test_tools::tolerance(1e-12));
  BOOST_TEST(groups["v"].value == 1.0, boost::test_tools::tolerance(1e-12));
}

BOOST_AUTO_TEST_CASE(are_those_of_effects_that_the_scene_has) {
  const auto none = groups_of(parsed(with_appended("")));
  BOOST_TEST(none.size() == 3U);
  const auto bending = groups_of(parsed(with_appended("[membrane]\nbending_modulus=2\n")));
  BOOST_TEST(bending.contains("t_κ"));
  BOOST_TEST(!bending.contains("χ"));
  const auto no_field = groups_of(parsed(with_appended(
      "[membrane]\nbending_modulus=2\n[electric]\nfield=[0,0,0]\nconductivity_in=1\nconductivity_out=0\n")));
  BOOST_TEST(!no_field.contains("Ca"));
  for (const auto& [symbol, group] : no_field) BOOST_TEST(std::isfinite(group.value), symbol);
}

BOOST_AUTO_TEST_CASE(of_further_effects_have_the_written_values) {
  auto groups = groups_of(
      parsed("[shape]\nkind='ellipsoid'\naxes=[2,2,2]\n[membrane]\nbending_modulus=0.5\nspontaneous_curvature=-0.25\n"
             "[fluid]\nviscosity=3\nviscosity_ratio=7\ndensity_difference=-2\n[gravity]\nacceleration=[0,3,4]\n"
             "[flow]\nkind='poiseuille'\ncentre_velocity=-5\nradius=4\n[electric]\nfield=[0,0,1]\nconductivity_in=1\n"
             "conductivity_out=2\npermittivity_ratio=0.3\n[electric.waveform]\nkind='ac'\nfrequency=0.25\n"
             "[numerics]\ndt=1\nend_time=1\n"));
  const auto tolerance = boost::test_tools::tolerance(1e-12);
  BOOST_TEST(groups["Λ"].value == 7.0);
  BOOST_TEST(groups["S"].value == 0.3);
  BOOST_TEST(groups["c₀"].value == -0.5, tolerance);
  // The spontaneous curvature is that of a sphere of half the radius, bulging outwards: C₀ = −2c = 1/2.
  BOOST_TEST(groups["C₀a"].value == 1.0, tolerance);
  BOOST_TEST(groups["t_g"].value == 3.0 / (2.0 * 5.0 * 2.0), tolerance);
  BOOST_TEST(!groups.contains("t_MW"));
  BOOST_TEST(groups["Bo"].value == 2.0 * 5.0 * 16.0 / 0.5, tolerance);
  BOOST_TEST(groups["χ"].value == 2.0 * 5.0 * 2.0 / 16.0 * 3.0 * 8.0 / 0.5, tolerance);
  BOOST_TEST(groups["ωt_m"].value == 0.5 * std::numbers::pi * groups["t_m"].value, tolerance);
}

BOOST_AUTO_TEST_CASE(si_text_needs_the_scale) {
  const vehd::Scene scene = parsed(si_scene());
  auto groups = groups_of(scene);
  BOOST_TEST(vehd::si_text(scene, groups["t_κ"]) == "50 s");
  BOOST_TEST(vehd::si_text(scene, groups["v"]) == "");
  BOOST_TEST(vehd::si_text(parsed(with_appended("")), groups["t_κ"]) == "");
}

BOOST_AUTO_TEST_SUITE_END()
