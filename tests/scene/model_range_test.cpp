#include "bie/scene/model_range.hpp"

#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <numbers>

#include "tests/scene/scene_text.hpp"

namespace {

using vehd::ReachedValues;

/// A nearly spherical giant vesicle of radius 10 um in a dc field for a millisecond, within the range of the model.
std::string quiet_scene(const std::string& more = {}) {
  return "[units]\n"
         "[shape]\nkind = \"prolate\"\nreduced_volume = 0.99\narea = \"1256.6370614359172 um^2\"\n"
         "[membrane]\nbending_modulus = \"2e-19 J\"\ncapacitance = \"0.01 F/m^2\"\n"
         "undulations = true\ntemperature = \"298 K\"\n"
         "[fluid]\nviscosity = \"1 mPa s\"\n"
         "[electric]\nfield = [0, 0, \"10 kV/m\"]\nconductivity_in = \"0.2 S/m\"\nconductivity_out = \"0.2 S/m\"\n"
         "permittivity = \"80 eps0\"\n"
         "[numerics]\ntolerance = 1e-3\nend_time = \"1 ms\"\n" +
         more;
}

std::string replaced(std::string text, const std::string& old, const std::string& by) {
  return text.replace(text.find(old), old.size(), by);
}

/// Warnings by name.
std::map<std::string, vehd::ModelWarning> warnings_of(const std::string& text,
                                                      const std::vector<ReachedValues>& reached = {}) {
  std::map<std::string, vehd::ModelWarning> result;
  for (const vehd::ModelWarning& warning : vehd::model_warnings(parsed(text), reached)) {
    result.emplace(warning.name, warning);
  }
  return result;
}

constexpr double rounding = 1e-12;

/// Value in units of the scene.
double scaled(const vehd::Scene& scene, double value, int length, int time, int viscosity) {
  return value / std::pow(*scene.units->length, length) / std::pow(*scene.units->time, time) /
         std::pow(*scene.units->viscosity, viscosity);
}

}  // namespace

BOOST_AUTO_TEST_SUITE(model_range)

BOOST_AUTO_TEST_CASE(a_weak_field_is_within_the_model) {
  BOOST_TEST(warnings_of(quiet_scene()).empty());
  BOOST_TEST(warnings_of(with_appended("")).empty());
}

// The membrane charges within a microsecond to 3/2 E a.
BOOST_AUTO_TEST_CASE(poration_follows_from_the_field_unless_the_scene_has_it) {
  const std::string strong = replaced(quiet_scene(), "10 kV/m", "100 kV/m");
  const auto found = warnings_of(strong);
  BOOST_TEST(found.at("poration").value == 1.5, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(found.at("poration").limit == 1.0);
  BOOST_TEST(found.at("poration").text ==
             "V_m reaches 1.5 V; membranes porate near 1 V, and the scene has no [poration]");
  const std::string criterion = "[poration]\nmodel = \"criterion\"\nthreshold_Vm = \"1 V\"\n";
  BOOST_TEST(!warnings_of(strong + criterion).contains("poration"));
  // The values reached in the run take precedence once they are available.
  BOOST_TEST(!warnings_of(strong, {ReachedValues{}}).contains("poration"));
}

BOOST_AUTO_TEST_CASE(an_alternating_field_charges_less) {
  const std::string strong = replaced(quiet_scene(), "10 kV/m", "100 kV/m");
  const auto at = [&](const char* frequency) {
    return warnings_of(strong + "[electric.waveform]\nkind = \"ac\"\naverage = true\nfrequency = \"" + frequency +
                       "\"\n");
  };
  BOOST_TEST(at("1 kHz").contains("poration"));
  BOOST_TEST(!at("1 MHz").contains("poration"));
}

BOOST_AUTO_TEST_CASE(lysis_is_judged_by_the_tension_of_the_run) {
  const vehd::Scene scene = parsed(quiet_scene());
  const ReachedValues reached{0.0, scaled(scene, 6e-3, 1, -1, 1), 0.0};
  const auto found = warnings_of(quiet_scene(), {reached});
  BOOST_TEST(found.size() == 1U);
  BOOST_TEST(found.at("lysis").value == 6e-3, boost::test_tools::tolerance(rounding));
  BOOST_TEST(found.at("lysis").limit == 5e-3);
  BOOST_TEST(!warnings_of(quiet_scene("[poration]\nmodel = \"criterion\"\nlysis_tension = \"8 mN/m\"\n"), {reached})
                  .contains("lysis"));
}

// Equal fluids relax in 3ε/3σ; the limit is a pulse of ten times that.
BOOST_AUTO_TEST_CASE(short_pulses_and_high_frequencies_need_displacement_currents) {
  const double relaxation = 80 * 8.8541878188e-12 / 0.2;
  const auto with = [&](const std::string& waveform, const std::string& text = quiet_scene()) {
    return warnings_of(text + "[electric.waveform]\n" + waveform);
  };
  const auto pulse = [&](double duration) { return fmt::format("kind = \"pulse\"\nduration = \"{} s\"\n", duration); };
  BOOST_TEST(!with(pulse(11 * relaxation)).contains("charge_relaxation"));
  const auto found = with(pulse(9 * relaxation));
  BOOST_TEST(found.at("charge_relaxation").value == 1.0 / 9.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(!with(pulse(9 * relaxation), replaced(quiet_scene(), "permittivity",
                                                   "displacement_current = true\n"
                                                   "permittivity"))
                  .contains("charge_relaxation"));
  const auto train = [&](double duration, double pause) {
    return fmt::format("kind = \"pulse_train\"\nduration = \"{} s\"\nperiod = \"{} s\"\n", duration, duration + pause);
  };
  BOOST_TEST(!with(train(11 * relaxation, 11 * relaxation)).contains("charge_relaxation"));
  BOOST_TEST(with(train(11 * relaxation, 9 * relaxation)).contains("charge_relaxation"));
  const auto ac = [&](double omega) {
    return fmt::format("kind = \"ac\"\naverage = true\nfrequency = \"{} Hz\"\n", omega / (2 * std::numbers::pi));
  };
  BOOST_TEST(with(ac(0.11 / relaxation)).contains("charge_relaxation"));
  BOOST_TEST(!with(ac(0.09 / relaxation)).contains("charge_relaxation"));
  BOOST_TEST(with(fmt::format("kind = \"table\"\ntimes = [0, \"{} s\"]\nvalues = [0, 1]\n", 9 * relaxation))
                 .contains("charge_relaxation"));
}

// Fluids of such low conductivity relax no faster than they charge the membrane.
BOOST_AUTO_TEST_CASE(slow_relaxation_of_the_fluids_is_said) {
  std::string text = si_scene();
  BOOST_TEST(!warnings_of(text).contains("charge_relaxation"));
  for (const char* conductivity : {"\"0.1 mS/cm\"", "\"20 mS/m\""}) {
    text = replaced(text, conductivity, "\"0.1 uS/cm\"");
  }
  BOOST_TEST(warnings_of(replaced(text, "\"100 S/m^2\"", "\"1e6 S/m^2\"")).contains("charge_relaxation"));
}

// λ_D = √(εD/σ) on both sides, C_m λ_D/ε each.
BOOST_AUTO_TEST_CASE(the_debye_length_grows_as_the_fluids_conduct_less) {
  std::string text = quiet_scene();
  for (int side = 0; side < 2; ++side) text = replaced(text, "\"0.2 S/m\"", "\"1 mS/m\"");
  const double permittivity = 80 * 8.8541878188e-12;
  const double length = std::sqrt(permittivity * 2e-9 / 1e-3);
  const auto found = warnings_of(text);
  BOOST_TEST(found.at("debye_length").value == 2 * 0.01 * length / permittivity, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(found.at("debye_length").text.find("37.64 nm") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(heating_counts_how_long_the_field_is_on) {
  const std::string second = replaced(quiet_scene(), "\"1 ms\"", "\"1 s\"");
  BOOST_TEST(warnings_of(second).at("heating").value == 0.2 * 1e8 / 4.18e6, boost::test_tools::tolerance(1e-9));
  const auto with = [&](const std::string& waveform) {
    const auto found = warnings_of(second + "[electric.waveform]\n" + waveform);
    return found.contains("heating") ? found.at("heating").value * 4.18e6 / 2e7 : 0.0;
  };
  BOOST_TEST(with("kind = \"ac\"\naverage = true\nfrequency = \"1 kHz\"\n") == 0.5, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(with("kind = \"pulse\"\nstart = \"0.2 s\"\nduration = \"0.6 s\"\n") == 0.6,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(with("kind = \"pulse\"\nduration = \"0.2 s\"\n") == 0.0);
  BOOST_TEST(with("kind = \"pulse_train\"\nduration = \"70 ms\"\nperiod = \"100 ms\"\n") == 0.7,
             boost::test_tools::tolerance(1e-9));
  BOOST_TEST(with("kind = \"pulse\"\nstart = \"-1 s\"\nduration = \"1.6 s\"\n") == 0.6,
             boost::test_tools::tolerance(1e-9));
  // The first pulse alone.
  BOOST_TEST(with("kind = \"pulse_train\"\nduration = \"0.6 s\"\nperiod = \"10 s\"\n") == 0.6,
             boost::test_tools::tolerance(1e-9));
  // A table is constant before its first time.
  BOOST_TEST(with("kind = \"table\"\ntimes = [\"0.8 s\", \"1 s\"]\nvalues = [1, 1]\n") == 1.0,
             boost::test_tools::tolerance(1e-9));
  // ∫ (2t)² dt = 4/3 of a second up to the end at t = 1.
  BOOST_TEST(with("kind = \"table\"\ntimes = [0, \"1 s\"]\nvalues = [0, 2]\n") == 4.0 / 3.0,
             boost::test_tools::tolerance(1e-9));
}

// A run that goes on from another one, or ends at rest, is judged by its own times.
BOOST_AUTO_TEST_CASE(heating_counts_the_times_that_a_run_has_reached) {
  const std::string hours = replaced(quiet_scene(), "\"1 ms\"", "\"3600 s\"");
  const double time_unit = *parsed(hours).units->time;
  const auto heating = [&](double start, double end) {
    const auto found = warnings_of(hours, {ReachedValues{0.0, 0.0, 0.0, 0.0, start / time_unit, end / time_unit}});
    return found.contains("heating") ? found.at("heating").value * 4.18e6 / 2e7 : 0.0;
  };
  BOOST_TEST(heating(0.0, 1.0) == 1.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(heating(99.0, 101.0) == 2.0, boost::test_tools::tolerance(1e-9));
  BOOST_TEST(heating(99.0, 99.1) == 0.0);
}

// Pulses that follow each other sooner than the membrane discharges charge it as a whole.
BOOST_AUTO_TEST_CASE(poration_counts_all_pulses_of_a_train) {
  const std::string strong = replaced(quiet_scene(), "10 kV/m", "100 kV/m");
  const auto with = [&](const std::string& waveform) {
    return warnings_of(strong + "[electric.waveform]\n" + waveform).contains("poration");
  };
  BOOST_TEST(!with("kind = \"pulse\"\nduration = \"0.2 us\"\n"));
  BOOST_TEST(!with("kind = \"pulse_train\"\nduration = \"0.2 us\"\nperiod = \"1 ms\"\n"));
  BOOST_TEST(with("kind = \"pulse_train\"\nduration = \"0.2 us\"\nperiod = \"0.22 us\"\n"));
}

BOOST_AUTO_TEST_CASE(inertia_is_judged_by_the_rate_of_flow_and_field) {
  const std::string shear = quiet_scene("[flow]\nkind = \"shear\"\nrate = \"2 1/ms\"\n");
  const double by_field = 9.0 * 80 * 8.8541878188e-12 * 1e8 / (55.0 * 1e-3);
  BOOST_TEST(warnings_of(shear).at("inertia").value == 1e3 * 1e-10 / 1e-3 * (2000.0 + by_field),
             boost::test_tools::tolerance(1e-6));
  const std::string table = "[flow.waveform]\nkind = \"table\"\ntimes = [0, \"1 ms\"]\nvalues = [1, -3]\n";
  BOOST_TEST(warnings_of(shear + table).at("inertia").value == 1e3 * 1e-10 / 1e-3 * (6000.0 + by_field),
             boost::test_tools::tolerance(1e-6));
}

BOOST_AUTO_TEST_CASE(constant_area_is_a_limit_where_undulations_would_give_some) {
  const std::string off =
      replaced(replaced(quiet_scene(), "undulations = true\n", ""), "temperature = \"298 K\"\n", "");
  const vehd::Scene scene = parsed(off);
  const double tension = 1e-6, area = 4 * std::numbers::pi * 1e-10, rigidity = 1e-19;
  const double strain =
      1.380649e-23 * 298 / (8 * std::numbers::pi * rigidity) * std::log1p(0.1 * tension * area / rigidity);
  const double excess = 4 * std::numbers::pi * (std::pow(0.99, -2.0 / 3.0) - 1);
  const auto found = warnings_of(off, {ReachedValues{0.0, 0.0, scaled(scene, tension, 1, -1, 1)}});
  BOOST_TEST(found.at("undulations").value == strain * (4 * std::numbers::pi + excess),
             boost::test_tools::tolerance(1e-6));
  BOOST_TEST(found.at("undulations").limit == 0.1 * excess, boost::test_tools::tolerance(1e-6));
  BOOST_TEST(!warnings_of(off, {ReachedValues{0.0, 0.0, -1.0}}).contains("undulations"));
  // The field by itself is expected to cause such a tension.
  BOOST_TEST(warnings_of(off).contains("undulations"));
  BOOST_TEST(!warnings_of(replaced(off, "reduced_volume = 0.99", "reduced_volume = 0.6")).contains("undulations"));
}

BOOST_AUTO_TEST_CASE(an_exact_sphere_under_a_force_keeps_its_shape) {
  const std::string sphere =
      replaced(with_appended("[flow]\nkind = \"shear\"\nrate = 1\n"), "1.0, 1.0, 2.0", "1, 1, 1");
  BOOST_TEST(warnings_of(sphere).contains("exact_sphere"));
  const std::string resting = replaced(sphere, "rate = 1", "rate = 0");
  BOOST_TEST(warnings_of(resting).empty());
  BOOST_TEST(warnings_of(resting + "[fluid]\ndensity_difference = 1\n[gravity]\nacceleration = [0, 0, -1]\n")
                 .contains("exact_sphere"));
  BOOST_TEST(
      warnings_of(sphere + "[membrane]\nbending_modulus = 1\nundulations = true\nstretching_modulus = 1\n").empty());
}

// A rest area 1 % above the area is more than undulations store: k_BT/(8πκ_c) is 0.0016.
BOOST_AUTO_TEST_CASE(a_membrane_that_is_too_large_for_its_shape_buckles) {
  const double area = 4 * std::numbers::pi * 1e-10;
  const auto with = [&](double rest_area) {
    return warnings_of(replaced(quiet_scene(), "undulations = true\n",
                                fmt::format("undulations = true\nrest_area = \"{} m^2\"\n", rest_area)));
  };
  BOOST_TEST(!with(area).contains("buckling"));
  const auto found = with(1.01 * area);
  BOOST_TEST(found.at("buckling").value > 0.99);
  BOOST_TEST(found.at("buckling").value <= 1.0);
}

BOOST_AUTO_TEST_CASE(of_several_vesicles_the_farthest_beyond_counts) {
  const std::string text =
      replaced(replaced(quiet_scene(), "10 kV/m", "60 kV/m"), "[units]\n", "[units]\nlength = \"10 um\"\n");
  const auto found = warnings_of(
      text + "[[vesicle]]\n[[vesicle]]\n[vesicle.shape]\narea = \"5026.548245743669 um^2\"\ncentre = [5, 0, 0]\n");
  BOOST_TEST(found.at("poration").value == 1.8, boost::test_tools::tolerance(1e-6));
  const std::string pair = quiet_scene("[[vesicle]]\n[[vesicle]]\nshape.centre = [5, 0, 0]\n");
  const double tension = scaled(parsed(pair), 9e-3, 1, -1, 1);
  BOOST_TEST(!warnings_of(pair, {{}, {}}).contains("lysis"));
  BOOST_TEST(warnings_of(pair, {{}, {.tension = tension}}).at("lysis").value == 9e-3,
             boost::test_tools::tolerance(rounding));
}

BOOST_AUTO_TEST_SUITE_END()
