#include "bie/scene/units.hpp"

#include <boost/test/unit_test.hpp>
#include <cmath>
#include <map>
#include <sstream>

#include "bie/scene/dimensionless_groups.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/schema.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(units)

namespace {

std::string without_line(std::string text, const std::string& start) {
  const std::size_t at = text.find("\n" + start) + 1;
  return text.erase(at, text.find('\n', at) + 1 - at);
}

std::string replaced(std::string text, const std::string& old_part, const std::string& new_part) {
  return text.replace(text.find(old_part), old_part.size(), new_part);
}

/// Message for the SI scene with a part replaced.
std::string message_with(const std::string& old_part, const std::string& new_part) {
  return message_of(replaced(si_scene(), old_part, new_part));
}

}  // namespace

BOOST_AUTO_TEST_CASE(quantities_are_parsed_however_they_are_spelled) {
  const auto unit_of = [](const char* text) { return vehd::parse_quantity(text)->unit; };
  BOOST_TEST(unit_of("1 kV/cm") == "kV/cm");
  BOOST_TEST(unit_of(" 1.5e-3m ") == "m");
  BOOST_TEST(unit_of("10 µm²") == "um^2");
  BOOST_TEST(unit_of("10 μm") == "um");
  BOOST_TEST(unit_of("1 mPa·s") == "mPa s");
  BOOST_TEST(unit_of("1 mPa * s") == "mPa s");
  BOOST_TEST(unit_of("1 mPa.s") == "mPa s");
  BOOST_TEST(unit_of("1 mPa⋅s") == "mPa s");
  BOOST_TEST(vehd::parse_quantity("-2e-20 J")->number == -2e-20);
  BOOST_TEST(!vehd::parse_quantity("high"));
  BOOST_TEST(!vehd::parse_quantity(""));
  BOOST_TEST(!vehd::parse_quantity("1e999 m"));
  BOOST_TEST(!vehd::parse_quantity("nan m"));
}

BOOST_AUTO_TEST_CASE(tensions_can_be_typed_as_they_are_printed) {
  const vehd::Dimension& dimension = *vehd::find_dimension("force/length");
  for (const double tension : {2.5, 2.5e-3, 2.5e-6, 2.5e-9}) {
    const std::string text = vehd::si_number(tension, dimension.name);
    const auto quantity = vehd::parse_quantity(text);
    BOOST_TEST_REQUIRE((quantity && dimension.find(quantity->unit) != nullptr), text);
    BOOST_TEST(quantity->in_si(*dimension.find(quantity->unit)) == tension, boost::test_tools::tolerance(1e-14));
  }
}

BOOST_AUTO_TEST_CASE(decimal_values_become_the_nearest_number_in_si) {
  const auto si = [](const char* dimension, const char* text) {
    const auto quantity = vehd::parse_quantity(text);
    return quantity->in_si(*vehd::find_dimension(dimension)->find(quantity->unit));
  };
  BOOST_TEST(si("length", "10 um") == 1e-5);
  BOOST_TEST(si("field", "1 kV/cm") == 1e5);
  BOOST_TEST(si("capacitance/area", "1 uF/cm^2") == 1e-2);
  BOOST_TEST(si("conductivity", "1 mS/cm") == 0.1);
  BOOST_TEST(si("conductivity", "1 uS/cm") == 1e-4);
  BOOST_TEST(si("conductance/area", "1 mS/cm^2") == 10.0);
  BOOST_TEST(si("energy", "20 zJ") == 2e-20);
  BOOST_TEST(si("1/time", "1 kHz") == 1e3);
  for (const char* text : {"1 mPa s", "1 mPas", "1mPa.s", "1 mPa·s", "1 cP"}) BOOST_TEST(si("viscosity", text) == 1e-3);
  BOOST_TEST(si("1/(area time)", "1 1/(m^2·s)") == 1.0);
  BOOST_TEST(si("1/(area time)", "1 1/(m²s)") == 1.0);
}

BOOST_AUTO_TEST_CASE(electric_scales_turn_charge_times_potential_into_energy) {
  const vehd::UnitsScene units{2.0, 3.0, 5.0, 7.0};
  const auto scale = [&](const char* name) { return *vehd::reference_scale(units, *vehd::find_dimension(name)); };
  const double energy = 5.0 * 8.0 / 3.0;  // viscosity length^3 / time
  const double charge = energy / 7.0;
  BOOST_TEST(scale("energy") == energy, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("field") == 7.0 / 2.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("capacitance/area") == charge / 7.0 / 4.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("conductance/area") == charge / 3.0 / 7.0 / 4.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("conductivity") == charge / 3.0 / 7.0 / 2.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("permittivity") == charge / 7.0 / 2.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("density") == 5.0 * 3.0 / 4.0, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(scale("acceleration") == 2.0 / 9.0, boost::test_tools::tolerance(1e-14));
}

BOOST_AUTO_TEST_CASE(values_are_divided_by_their_scale) {
  const vehd::Scene scene = parsed(si_scene());
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  const double energy = 1e-3 * 1e-15 / 0.5;
  BOOST_TEST(*scene.shape.area == 12.566370614359172, tolerance);
  BOOST_TEST(*scene.membrane.bending_modulus == 2e-20 / energy, tolerance);
  BOOST_TEST(scene.membrane.capacitance == 0.01 / (energy / 1e-6 / 1e-10), tolerance);
  BOOST_TEST(scene.membrane.conductance == 100.0 / (energy / 1e-6 / 0.5 / 1e-10), tolerance);
  BOOST_TEST(scene.fluid.viscosity == 1.0, tolerance);
  BOOST_TEST(scene.flow->rate == 1.0, tolerance);
  BOOST_TEST(scene.electric->field[2] == 1e4 / (1e-3 / 1e-5), tolerance);
  BOOST_TEST(scene.electric->conductivity_in == 0.01 / (energy / 1e-6 / 0.5 / 1e-5), tolerance);
  BOOST_TEST(scene.electric->permittivity == 80.0 * 8.8541878188e-12 / (energy / 1e-6 / 1e-5), tolerance);
  BOOST_TEST(*scene.numerics.dt == 0.02, tolerance);
  BOOST_TEST(scene.numerics.end_time == 2.0, tolerance);
}

BOOST_AUTO_TEST_CASE(plain_numbers_stay_dimensionless) {
  BOOST_TEST(*parsed(replaced(si_scene(), "\"2e-20 J\"", "0.25")).membrane.bending_modulus == 0.25);
}

BOOST_AUTO_TEST_CASE(absent_scales_make_radius_viscosity_shortest_time_and_capacitance_one) {
  std::string text = si_scene();
  for (const char* line : {"length = ", "time = ", "viscosity = ", "potential = "}) text = without_line(text, line);
  const vehd::Scene scene = parsed(text);
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  BOOST_TEST(*scene.units->length == 1e-5, tolerance);
  BOOST_TEST(*scene.shape.area == 12.566370614359172, tolerance);
  BOOST_TEST(scene.fluid.viscosity == 1.0, tolerance);
  BOOST_TEST(scene.membrane.capacitance == 1.0, tolerance);
  const double charging_time = 1e-5 * 0.01 * (1.0 / 0.01 + 0.5 / 0.02);
  BOOST_TEST(*scene.units->time == charging_time, tolerance);
  BOOST_TEST(*scene.numerics.dt == 0.01 / charging_time, tolerance);
}

BOOST_AUTO_TEST_CASE(absent_time_is_the_shortest_that_the_scene_gives_in_si) {
  const auto tolerance = boost::test_tools::tolerance(1e-14);
  const auto time = [](const std::string& text) { return parsed(text).units->time.value_or(0.0); };
  const std::string start = "[units]\nlength = '10 um'\nviscosity = '1 mPa s'\npotential = '1 V'\n" +
                            with_appended("[fluid]\nviscosity = 1\n");
  const auto electric = [](const std::string& conductivities, const std::string& more) {
    // A number without a unit does not determine the time.
    const std::string number = more.find("permittivity") == std::string::npos ? "permittivity = 1\n" : "";
    return "[membrane]\ncapacitance = '10 mF/m^2'\n[electric]\nfield = [0, '-4 kV/m', '3 kV/m']\n" + conductivities +
           number + more;
  };
  const std::string conducting = "conductivity_in = '0.5 mS/cm'\nconductivity_out = '1 mS/cm'\n";
  const std::string plain = "conductivity_in = 1\nconductivity_out = 0\n";
  BOOST_TEST(time(start + "[membrane]\nbending_modulus = '2e-20 J'\n") == 1e-3 * 1e-15 / 2e-20, tolerance);
  BOOST_TEST(time(start + "[flow]\nkind = 'shear'\nrate = '-4 1/s'\n") == 0.25, tolerance);
  BOOST_TEST(
      time(start + "[flow]\nkind = 'gradient'\ngradient = [[0, '3 1/s', '-4 1/s'], [0, 0, '1 1/s'], [0, 0, 0]]\n") ==
          0.2,
      tolerance);
  BOOST_TEST(time(start + "[flow]\nkind = 'poiseuille'\ncentre_velocity = '-1 mm/s'\nradius = '50 um'\n") == 0.05,
             tolerance);
  BOOST_TEST(
      time(start + "[flow]\nkind = 'shear'\nrate = '1 1/s'\n[flow.waveform]\nkind = 'ac'\nfrequency = '8 Hz'\n") ==
          0.125,
      tolerance);
  BOOST_TEST(time(start + electric(conducting, "")) == 1e-7 * (1.0 / 0.05 + 0.5 / 0.1), tolerance);
  BOOST_TEST(time(start + electric(plain, "permittivity = '80 eps0'\n")) == 1e-3 / (80 * 8.8541878188e-12 * 25e6),
             tolerance);
  BOOST_TEST(time(start + electric(plain, "[electric.waveform]\nkind = 'pulse'\nduration = '100 us'\n")) == 1e-4,
             tolerance);
  BOOST_TEST(time(start + electric(plain,
                                   "[electric.waveform]\nkind = 'pulse_train'\nduration = '2 ms'\n"
                                   "period = '50 ms'\n")) == 2e-3,
             tolerance);
  // The shortest of several times is used, whatever their order.
  const std::string pulse = "[electric.waveform]\nkind = 'pulse'\nduration = '1 us'\n";
  BOOST_TEST(time(start + electric(conducting, "permittivity = '80 eps0'\n" + pulse)) == 1e-6, tolerance);
  // Values that have no unit or are zero do not determine the time.
  BOOST_TEST(time(start + "[membrane]\ncapacitance = 1\n[electric]\nfield = [0, 0, '1 kV/m']\npermittivity = 1\n" +
                  plain + "[electric.waveform]\nkind = 'pulse'\nduration = 1\n") == 0.0);
  BOOST_TEST(time(start + "[flow]\nkind = 'shear'\nrate = '0 1/s'\n[membrane]\nbending_modulus = '1e-18 J'\n") == 1.0,
             tolerance);
  BOOST_TEST(time(start + "[membrane]\ncapacitance = 3\n") == 0.0);
  // A time stated in the scene is not replaced.
  BOOST_TEST(time(replaced(start, "[units]\n", "[units]\ntime = '3 s'\n") + electric(conducting, pulse)) == 3.0);
}

BOOST_AUTO_TEST_CASE(an_absent_scale_that_no_value_needs_is_no_error) {
  const std::string text = with_appended("[units]\nlength = '1 um'\n[fluid]\nviscosity = 1\n");
  BOOST_TEST(message_of(text) == "");
  BOOST_TEST(!parsed(text).units->time.has_value());
  BOOST_TEST(message_of(replaced(text, "[1.0, 1.0, 2.0]", "['1 um', '1 um', '2000 nm']")) == "");
}

BOOST_AUTO_TEST_CASE(absent_scale_that_a_value_needs) {
  std::string text = without_line(si_scene(), "time = ");
  for (const char* value : {"\"2e-20 J\"", "\"2 1/s\"", "\"0.1 mS/cm\"", "\"80 eps0\""})
    text = replaced(text, value, "0.25");
  BOOST_TEST(message_of(text) ==
             "scene.toml:11: \"capacitance\" in [membrane] is the text '1 uF/cm^2', but the scene has no reference "
             "time; accepted: \"time\" in [units], or a unit for a value that sets a time, such as \"duration\" of a "
             "pulse, \"rate\" in [flow] or \"bending_modulus\" in [membrane]");
}

BOOST_AUTO_TEST_CASE(numbers_convert_by_the_ratio_of_their_scales) {
  const std::optional<vehd::UnitsScene> um = vehd::UnitsScene{1e-6, {}, {}, {}}, none, empty = vehd::UnitsScene{};
  const std::optional<vehd::UnitsScene> nm = vehd::UnitsScene{1e-9, 1.0, {}, {}};
  const auto length = &vehd::UnitsScene::length;
  BOOST_TEST(*vehd::conversion(um, nm, length) == 1e3, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(*vehd::conversion(nm, um, length) == 1e-3, boost::test_tools::tolerance(1e-15));
  BOOST_TEST(*vehd::conversion(none, empty, length) == 1.0);
  BOOST_TEST(!vehd::conversion(um, none, length));
  BOOST_TEST(!vehd::conversion(empty, um, length));
  BOOST_TEST(!vehd::conversion(um, nm, &vehd::UnitsScene::time));
  BOOST_TEST(vehd::si_scale(um, "length") == 1e-6);
  BOOST_TEST(vehd::si_scale(um, "1") == 1.0);
  BOOST_TEST(std::isnan(vehd::si_scale(um, "velocity")));
  BOOST_TEST(std::isnan(vehd::si_scale(none, "length")));
}

// SI base-unit values of prefixes and composed units, written out by hand.
BOOST_AUTO_TEST_CASE(every_unit_has_the_size_of_its_name) {
  const std::map<std::string, double> sizes = {
      {"m", 1},          {"mm", 1e-3},     {"um", 1e-6},      {"nm", 1e-9},
      {"m^2", 1},        {"mm^2", 1e-6},   {"um^2", 1e-12},   {"1/m", 1},
      {"1/mm", 1e3},     {"1/um", 1e6},    {"s", 1},          {"ms", 1e-3},
      {"us", 1e-6},      {"ns", 1e-9},     {"1/s", 1},        {"1/ms", 1e3},
      {"Hz", 1},         {"kHz", 1e3},     {"MHz", 1e6},      {"m/s", 1},
      {"mm/s", 1e-3},    {"um/s", 1e-6},   {"m/s^2", 1},      {"kg/m^3", 1},
      {"g/cm^3", 1e3},   {"Pa s", 1},      {"mPa s", 1e-3},   {"cP", 1e-3},
      {"J", 1},          {"aJ", 1e-18},    {"zJ", 1e-21},     {"V", 1},
      {"mV", 1e-3},      {"V/m", 1},       {"kV/m", 1e3},     {"V/cm", 1e2},
      {"kV/cm", 1e5},    {"S/m", 1},       {"mS/m", 1e-3},    {"mS/cm", 1e-1},
      {"uS/cm", 1e-4},   {"F/m", 1},       {"pF/m", 1e-12},   {"eps0", 8.8541878188e-12},
      {"F/m^2", 1},      {"mF/m^2", 1e-3}, {"uF/cm^2", 1e-2}, {"S/m^2", 1},
      {"S/cm^2", 1e4},   {"mS/cm^2", 1e1}, {"K", 1},          {"kBT", 1.380649e-23 * 300.0},
      {"m^3", 1},        {"Pa", 1},        {"N/m", 1},        {"mN/m", 1e-3},
      {"uN/m", 1e-6},    {"nN/m", 1e-9},   {"J/m^2", 1},      {"mJ/m^2", 1e-3},
      {"uJ/m^2", 1e-6},  {"C m", 1},       {"C/m^2", 1},      {"W", 1},
      {"1/m^2", 1},      {"1/um^2", 1e12}, {"1/(m^2 s)", 1},  {"1/(um^2 us)", 1e18},
      {"A/m^2", 1},      {"mA/m^2", 1e-3}, {"mA/cm^2", 1e1},  {"uA/cm^2", 1e-2},
      {"nA/cm^2", 1e-5}, {"N", 1}};
  for (const vehd::Dimension& dimension : vehd::dimensions()) {
    for (const vehd::Unit& unit : dimension.units) {
      const auto size = sizes.find(std::string(unit.symbol));
      BOOST_TEST_REQUIRE((size != sizes.end()), unit.symbol);
      // A temperature given as a thermal energy is k_BT.
      const bool is_thermal = dimension.name == "thermal energy" && unit.symbol == "K";
      const vehd::Quantity three{3.0, std::string(unit.symbol)};
      BOOST_TEST(three.in_si(unit, 300.0) == 3.0 * (is_thermal ? 1.380649e-23 : size->second),
                 boost::test_tools::tolerance(1e-15));
    }
  }
}

BOOST_AUTO_TEST_CASE(a_thermal_energy_is_that_of_the_temperature_of_the_scene) {
  const std::string thermal = replaced(si_scene(), "\"2e-20 J\"", "\"20 kBT\"");
  const std::string warm = replaced(thermal, "[units]\n", "[units]\ntemperature = \"300 K\"\n");
  const double energy = 20.0 * 1.380649e-23 * 300.0, scale = 1e-3 * 1e-15 / 0.5;
  BOOST_TEST(*parsed(warm).membrane.bending_modulus == energy / scale, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(message_of(thermal) ==
             "scene.toml:11: \"bending_modulus\" in [membrane] is the text '20 kBT', but the scene has no temperature; "
             "accepted: \"temperature\" in [units] with the unit K");
  // The reference time can follow from the bending time.
  const std::string start =
      "[units]\nlength = '10 um'\nviscosity = '1 mPa s'\n" + with_appended("[fluid]\nviscosity = 1\n");
  const std::string bending = "[membrane]\nbending_modulus = '20 kBT'\n";
  const std::string at = replaced(start, "[units]\n", "[units]\ntemperature = '300 K'\n");
  BOOST_TEST(*parsed(at + bending).units->time == 1e-3 * 1e-15 / energy, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(message_with("\"10 um\"", "'10 kBT'") ==
             "scene.toml:2: \"length\" in [units] is the text '10 kBT', whose unit \"kBT\" is none of length (nearest: "
             "\"m\"); accepted: m, mm, um, nm");
}

// A default of 1 in scene units would be 5e-11 F/m here and would change with the reference time.
BOOST_AUTO_TEST_CASE(a_default_in_units_is_required_beside_units) {
  const std::map<std::string, std::string> lines = {{"membrane.capacitance", "capacitance = "},
                                                    {"fluid.viscosity", "viscosity = \"1 mPa s\"\n[flow]"},
                                                    {"electric.permittivity", "permittivity = "}};
  const std::string radial = replaced(without_line(without_line(si_scene(), "area = "), "reduced_volume = "),
                                      "kind = \"prolate\"\n", "kind = 'radial'\nmodes = []\n");
  int count = 0;
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    if (!vehd::has_default_in_units(key)) continue;
    const auto line = lines.find(std::string(key.table) + "." + std::string(key.name));
    const std::string message = message_of(line == lines.end() ? radial : without_line(si_scene(), line->second));
    BOOST_TEST_CONTEXT(key.table << "." << key.name << ": " << message) {
      BOOST_TEST(message.find(std::string("missing key \"") + std::string(key.name) + "\" in [" +
                              std::string(key.table) + "]") != std::string::npos);
      BOOST_TEST(message.find("; its default of 1 would be ") != std::string::npos);
      BOOST_TEST(message.find("; accepted: ") != std::string::npos);
    }
    ++count;
  }
  BOOST_TEST(count == 4);
  const std::string message = message_of(without_line(si_scene(), "permittivity = "));
  BOOST_TEST(
      message.starts_with("scene.toml:19: missing key \"permittivity\" in [electric] (of the fluid outside); its "
                          "default of 1 would be 2e-07 F/m; accepted: "),
      message);
  // An explicit number is accepted, and a key without effect is not required.
  BOOST_TEST(parsed(replaced(si_scene(), "\"80 eps0\"", "2.5")).electric->permittivity == 2.5);
  BOOST_TEST(message_of(replaced(radial, "modes", "base = 1\nmodes")) == "");
  BOOST_TEST(message_of(with_appended("[units]\nlength = '1 um'\n[fluid]\nviscosity = 2\n")) == "");
}

// Regression: the area of 4π of these shapes was 1e-11 m² or 1e-9 m² without a word, as the reference length had it.
BOOST_AUTO_TEST_CASE(a_shape_of_area_4_pi_needs_a_size_beside_units) {
  for (const std::string kind : {"prolate", "oblate", "biconcave", "stomatocyte"}) {
    for (const char* length : {"10 um", "1 um"}) {
      const std::string sized =
          replaced(replaced(replaced(si_scene(), "10 um", length), "prolate", kind), "0.9", "0.6");
      BOOST_TEST(message_of(sized) == "");
      const std::string unsized = without_line(sized, "area = ");
      BOOST_TEST(message_of(unsized) ==
                 "scene.toml:6: missing key \"area\" in [shape]; its default of 4π depends on "
                 "[units]; accepted: > 0, or a \"scale\"");
      BOOST_TEST(message_of(replaced(unsized, "[membrane]", "scale = 2\n[membrane]")) == "");
    }
  }
}

// Whichever key is omitted, a scene in SI units is either refused or the same in all reference units.
BOOST_AUTO_TEST_CASE(no_key_that_is_left_out_depends_on_the_reference_scales) {
  std::istringstream lines(si_scene());
  std::vector<std::string> keys;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with('[')) keys.push_back(line);
  }
  int accepted = 0;
  for (const std::string& line : keys) {
    const std::string text = without_line(si_scene(), line);
    if (text.find("[units]\nlength") == std::string::npos || !message_of(text).empty()) continue;
    const vehd::Scene one = parsed(text), other = parsed(replaced(text, "length = \"10 um\"", "length = \"3 um\""));
    for (const vehd::KeyDescription& key : vehd::scene_keys()) {
      if (!vehd::applies(key, one) || key.type != vehd::ValueType::number) continue;
      const auto si = [&](const vehd::Scene& scene) {
        const auto value = key.get(scene);
        return value ? std::get<double>(*value) * vehd::si_scale(scene.units, key.unit) : 0.0;
      };
      BOOST_TEST_CONTEXT("without " << line << ": " << key.table << "." << key.name) {
        BOOST_TEST(si(one) == si(other), boost::test_tools::tolerance(1e-13));
      }
    }
    ++accepted;
  }
  BOOST_TEST(accepted >= 4);
}

BOOST_AUTO_TEST_CASE(unit_in_a_scene_without_units) {
  BOOST_TEST(message_of(with_appended("[fluid]\nviscosity = '1 mPa s'\n")) ==
             "scene.toml:9: \"viscosity\" in [fluid] is the text '1 mPa s', but the scene has no table [units]; "
             "accepted: a number > 0");
}

BOOST_AUTO_TEST_CASE(wrong_units_name_the_accepted_ones) {
  BOOST_TEST(
      message_with("\"2e-20 J\"", "'2e-20 N'") ==
      "scene.toml:11: \"bending_modulus\" in [membrane] is the text '2e-20 N', whose unit \"N\" is none of energy "
      "(nearest: \"J\"); accepted: J, aJ, zJ, kBT");
  BOOST_TEST(message_with("\"0.1 kV/cm\"", "'0.1 kV'") ==
             "scene.toml:20: \"field\" in [electric] is the text '0.1 kV', whose unit \"kV\" is none of field "
             "(nearest: \"kV/m\"); accepted: V/m, kV/m, V/cm, kV/cm");
  BOOST_TEST(message_with("\"10 ms\"", "'10'") ==
             "scene.toml:25: \"dt\" in [numerics] is the text '10', without a unit; accepted: s, ms, us, ns");
  BOOST_TEST(message_with("\"10 ms\"", "'soon'") ==
             "scene.toml:25: \"dt\" in [numerics] is the text 'soon'; accepted: a number > 0");
  BOOST_TEST(message_with("reduced_volume = 0.9", "reduced_volume = '0.9 m'") ==
             "scene.toml:8: \"reduced_volume\" in [shape] is the text '0.9 m'; accepted: a number 0.2 ... 1");
  BOOST_TEST(message_with("\"10 ms\"", "'-10 ms'") ==
             "scene.toml:25: \"dt\" in [numerics] is the text '-10 ms'; accepted: a number > 0");
}

BOOST_AUTO_TEST_CASE(reference_scales_need_a_unit_and_a_positive_number) {
  const std::string accepted = "; accepted: a positive number with its unit in quotes, m, mm, um, nm";
  BOOST_TEST(message_with("\"10 um\"", "10.0") == "scene.toml:2: \"length\" in [units] is 10.0" + accepted);
  BOOST_TEST(message_with("\"10 um\"", "'0 um'") ==
             "scene.toml:2: \"length\" in [units] is the text '0 um'" + accepted);
  BOOST_TEST(message_with("\"10 um\"", "'10 us'") ==
             "scene.toml:2: \"length\" in [units] is the text '10 us', whose unit \"us\" is none of length (nearest: "
             "\"um\"); accepted: m, mm, um, nm");
}

// An unreadable value determines no reference scale; earlier keys that need the scale must not be blamed.
BOOST_AUTO_TEST_CASE(a_value_that_should_give_a_scale_is_to_blame_if_it_cannot_be_read) {
  const std::string text = without_line(without_line(si_scene(), "viscosity = \"1 mPa s\"\npot"), "viscosity = ");
  const auto message = [&](const std::string& viscosity) {
    return message_of(replaced(text, "[fluid]\n", "[fluid]\nviscosity = " + viscosity + "\n"));
  };
  BOOST_TEST(message("'1 mPa s'") == "");
  BOOST_TEST(message("'1 cp'") ==
             "scene.toml:14: \"viscosity\" in [fluid] is the text '1 cp', whose unit \"cp\" is none of viscosity "
             "(nearest: \"cP\"); accepted: Pa s, mPa s, cP");
  for (const char* value : {"'1 µPa s'", "'0 Pa s'", "'-1 Pa s'", "'thin'", "'1'", "true", "[]"}) {
    BOOST_TEST(message(value).starts_with("scene.toml:14: \"viscosity\" in [fluid] is "), message(value));
  }
  BOOST_TEST(message("'1 µPa s'").find("unit \"µPa s\"") != std::string::npos, message("'1 µPa s'"));
}

BOOST_AUTO_TEST_CASE(checks_say_times_as_typed) {
  BOOST_TEST(message_of(si_scene() + "[output]\ntimes = [\"2 ms\", \"0.5 ms\"]\n").find("falls to 0.5 ms; accepted") !=
             std::string::npos);
  BOOST_TEST(message_of(si_scene() + "[[output.window]]\nfrom = \"2 ms\"\nto = \"0.5 ms\"\nevery = \"1 us\"\n")
                 .find("goes from 2 ms to 0.5 ms every 1 us; accepted") != std::string::npos);
  BOOST_TEST(message_of(si_scene() + "[electric.waveform]\nkind = \"pulse_train\"\nduration = \"3 ms\"\nperiod = "
                                     "\"2 ms\"\n")
                 .find("is 2 ms; accepted: more than the duration 3 ms") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
