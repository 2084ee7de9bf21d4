#include "bie/scene/output_units.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <string>

#include "bie/scene/units.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(output_units)

namespace {

vehd::OutputUnits units_of(const std::string& text) { return vehd::OutputUnits(parsed(text)); }

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  return text.replace(text.find(old_part), old_part.size(), new_part);
}

constexpr const char* shown[] = {"length",           "area",      "volume", "time",       "velocity", "force/length",
                                 "potential/length", "potential", "energy", "force/area", "dipole",   "power"};

}  // namespace

BOOST_AUTO_TEST_CASE(every_dimension_has_one_unit) {
  const vehd::OutputUnits units = units_of(si_scene());
  const auto symbol = [&](const char* dimension) { return units.of(dimension).symbol; };
  BOOST_TEST(symbol("length") == "um");
  BOOST_TEST(symbol("area") == "um^2");
  BOOST_TEST(symbol("volume") == "um^3");
  BOOST_TEST(symbol("time") == "ms");
  BOOST_TEST(symbol("velocity") == "um/s");
  BOOST_TEST(symbol("potential") == "mV");
  BOOST_TEST(symbol("potential/length") == "kV/m");
  BOOST_TEST(symbol("force/length") == "mN/m");
  BOOST_TEST(symbol("force/area") == "Pa");
  BOOST_TEST(symbol("force") == "pN");
  BOOST_TEST(symbol("energy") == "fJ");
  BOOST_TEST(symbol("dipole") == "zC m");
  BOOST_TEST(symbol("power") == "fW");
  BOOST_TEST(symbol("1") == "");
}

BOOST_AUTO_TEST_CASE(numbers_times_the_factor_are_in_the_unit) {
  const vehd::OutputUnits units = units_of(si_scene());
  const auto tolerance = boost::test_tools::tolerance(1e-15);
  BOOST_TEST(units.of("length").factor == 10.0, tolerance);
  BOOST_TEST(units.of("area").factor == 100.0, tolerance);
  BOOST_TEST(units.of("volume").factor == 1000.0, tolerance);
  BOOST_TEST(units.of("time").factor == 500.0, tolerance);
  BOOST_TEST(units.of("velocity").factor == 20.0, tolerance);
  BOOST_TEST(units.of("potential").factor == 1.0, tolerance);
  BOOST_TEST(units.of("potential/length").factor == 0.1, tolerance);
  BOOST_TEST(units.of("time").text_of(0.25) == "125 ms");
}

BOOST_AUTO_TEST_CASE(no_scene_changes_a_unit) {
  std::string other = si_scene();
  for (const auto& [from, to] : {std::pair{"\"10 um\"", "\"3 nm\""},
                                 {"500 ms", "7 us"},
                                 {"= \"1 mV", "= \"2 V"},
                                 {"end_time = \"1 s\"", "end_time = \"1 ns\""}}) {
    other = replaced(other, from, to);
  }
  other = replaced(other, "viscosity = \"1 mPa s\"", "viscosity = \"2 Pa s\"");
  const vehd::OutputUnits a = units_of(si_scene()), b = units_of(other);
  for (const char* dimension : shown) BOOST_TEST(a.of(dimension).symbol == b.of(dimension).symbol, dimension);
}

// A result unit that is not among the accepted units would leave numbers dimensionless.
BOOST_AUTO_TEST_CASE(every_unit_of_results_is_one_of_its_dimension) {
  const vehd::UnitsScene ones{1.0, 1.0, 1.0, 1.0};
  for (const vehd::Dimension& dimension : vehd::dimensions()) {
    if (dimension.result_unit.empty()) continue;
    const std::string name(dimension.name), symbol(dimension.result_unit);
    BOOST_TEST(vehd::OutputUnits(ones, {{name, symbol}}).of(name).symbol == symbol, name);
  }
}

BOOST_AUTO_TEST_CASE(default_is_si_where_the_scene_has_units) {
  BOOST_TEST(!units_of(with_appended("")).of("time").is_si());
  BOOST_TEST(!units_of(si_scene() + "[output]\nunits = \"dimensionless\"\n").of("time").is_si());
  BOOST_TEST(units_of(si_scene() + "[output]\nunits = \"si\"\n").of("time").is_si());
  BOOST_TEST(units_of(with_appended("")).of("length").factor == 1.0);
  BOOST_TEST(message_of(with_appended("[output]\nunits = \"si\"\n")) ==
             "scene.toml:9: \"units\" in [output] is \"si\", but the scene has no table [units]");
}

BOOST_AUTO_TEST_CASE(columns_without_scale_stay_dimensionless) {
  const vehd::OutputUnits units = units_of(with_appended("[units]\nlength = \"1 um\"\n[fluid]\nviscosity = 1\n"));
  BOOST_TEST(units.of("length").symbol == "um");
  BOOST_TEST(!units.of("time").is_si());
  BOOST_TEST(!units.of("velocity").is_si());
}

BOOST_AUTO_TEST_CASE(a_run_that_has_begun_keeps_its_symbols) {
  const vehd::OutputUnits units(vehd::UnitsScene{1e-6, 1e-3, {}, {}},
                                {{"length", "nm"}, {"area", "mm^2"}, {"velocity", "ells"}});
  BOOST_TEST(units.of("length").factor == 1000.0, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(units.of("area").factor == 1e-6, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(!units.of("time").is_si());
  BOOST_TEST(!units.of("velocity").is_si());
}

// The expected values are written out by hand.
BOOST_AUTO_TEST_CASE(every_prefix_has_the_factor_of_its_name) {
  const vehd::UnitsScene ones{1.0, 1.0, 1.0, 1.0};
  for (const auto& [prefix, size] : {std::pair{"M", 1e6},
                                     {"k", 1e3},
                                     {"", 1.0},
                                     {"m", 1e-3},
                                     {"u", 1e-6},
                                     {"n", 1e-9},
                                     {"p", 1e-12},
                                     {"f", 1e-15},
                                     {"a", 1e-18},
                                     {"z", 1e-21}}) {
    const std::string p = prefix;
    const vehd::OutputUnits units(ones, {{"potential", p + "V"}, {"area", p + "m^2"}, {"volume", p + "m^3"}});
    const auto tolerance = boost::test_tools::tolerance(1e-14);
    BOOST_TEST(units.of("potential").factor * size == 1.0, tolerance);
    BOOST_TEST(units.of("area").factor * size * size == 1.0, tolerance);
    BOOST_TEST(units.of("volume").factor * size * size * size == 1.0, tolerance);
    BOOST_TEST(vehd::si_number(2.5 * size, "potential") == "2.5 " + p + "V");
    BOOST_TEST(vehd::si_number(2.5 * size * size, "area") == "2.5 " + p + "m^2");
  }
}

BOOST_AUTO_TEST_CASE(print_has_the_signs_that_ascii_lacks) {
  BOOST_TEST(vehd::printed_unit("um^3") == "µm³");
  BOOST_TEST(vehd::printed_unit("um/s") == "µm/s");
  BOOST_TEST(vehd::printed_unit("eps0") == "ε₀");
  BOOST_TEST(vehd::with_unit("time", "ms") == "time (ms)");
  BOOST_TEST(vehd::with_unit("time", "") == "time");
  BOOST_TEST(vehd::si_number(0.012, "time") == "12 ms");
  BOOST_TEST(vehd::si_number(1e-5, "length") == "10 um");
  BOOST_TEST(vehd::si_number(1e4, "1/time") == "1e+04 1/s");
}

BOOST_AUTO_TEST_SUITE_END()
