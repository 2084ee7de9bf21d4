#include <toml++/toml.h>

#include <bit>
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <cstdlib>
#include <random>

#include "bie/scene/effective_scene.hpp"
#include "bie/scene/read/toml_values.hpp"
#include "bie/scene/units.hpp"
#include "tests/scene/key_values.hpp"
#include "tests/scene/scene_text.hpp"

BOOST_AUTO_TEST_SUITE(written_numbers)

namespace {

/// A number as spelled in a scene, and the double nearest to it.
struct Literal {
  std::string text;
  double value;
};

Literal decimal(const std::string& text) { return {text, std::strtod(text.c_str(), nullptr)}; }

std::vector<Literal> literals() {
  std::vector<Literal> all = {{"1_000_000", 1e6},
                              {"9_007_199_254_740_993", 9007199254740992.0},
                              {"0x7fff_ffff_ffff_ffff", 9223372036854775807.0},
                              {"0x20000000000001", 9007199254740992.0},
                              {"0o777777777777777777777", 9223372036854775807.0},
                              {"0b100000000000000000000000000000000000000000000000000000000", 72057594037927936.0},
                              {"+0.5", 0.5},
                              {"1_0.2_5e+1_0", 10.25e10}};
  for (const char* text : {"0",
                           "1",
                           "-1",
                           "64",
                           "9007199254740991",
                           "9007199254740992",
                           "9007199254740993",
                           "-9007199254740993",
                           "40500000000000000",
                           "-40500000000000000",
                           "9223372036854775807",
                           "-9223372036854775808",
                           "1e22",
                           "1e23",
                           "1.7976931348623157e308",
                           "2.2250738585072014e-308",
                           "4.9e-324",
                           "0.1000000000000000055511151231257827",
                           "9007199254740992.999",
                           "123456789012345678901234567890.0",
                           "0.000001",
                           "1000000.0"}) {
    all.push_back(decimal(text));
  }
  std::mt19937_64 random(20240517);
  for (int bits = 40; bits < 63; ++bits) {
    const std::uint64_t size = random() >> (64 - bits) | std::uint64_t{1} << (bits - 1);
    all.push_back(decimal(fmt::format("{}", size)));
    all.push_back(decimal(fmt::format("-{}", size)));
  }
  for (int i = 0; i < 40; ++i) {
    const double value = std::bit_cast<double>(random());
    if (!std::isfinite(value)) continue;
    all.push_back(decimal(fmt::format("{:.17e}", value)));
    all.push_back(decimal(fmt::format("{:.3e}", value)));
    all.push_back(decimal(fmt::format("{:.25f}", static_cast<double>(random()) * 0x1p-60)));
  }
  return all;
}

/// The number inserted by value_with_number.
double number_in(const vehd::Value& value) {
  struct Number {
    double operator()(bool) const { return std::nan(""); }
    double operator()(std::int64_t number) const { return static_cast<double>(number); }
    double operator()(double number) const { return number; }
    double operator()(const std::string&) const { return std::nan(""); }
    double operator()(const vehd::Triple& numbers) const { return numbers[1]; }
    double operator()(const vehd::TripleOfTriples& rows) const { return rows[1][2]; }
    double operator()(const vehd::AxisAngle& numbers) const { return numbers[3]; }
    double operator()(const std::vector<double>& numbers) const { return numbers.at(1); }
    double operator()(const std::vector<vehd::HarmonicMode>& modes) const { return modes.at(0).a; }
    double operator()(const std::vector<vehd::OutputWindow>& windows) const { return windows.at(0).to; }
  };
  return std::visit(Number{}, value);
}

struct Reading {
  std::optional<double> number;
  std::string refusal;
};

Reading read(const vehd::KeyDescription& key, const std::string& value) {
  const toml::table file = toml::parse("\nkey = " + value + "\n");
  try {
    return {number_in(vehd::checked_value(key, *file.get("key"), "scene.toml", vehd::UnitsScene{1, 1, 1, 1})), ""};
  } catch (const vehd::InputError& error) {
    return {std::nullopt, error.what()};
  }
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_key_reads_the_number_that_is_written_or_refuses_it_by_its_line) {
  int read_count = 0;
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    const vehd::Dimension* dimension = vehd::find_dimension(key.unit);
    const std::string unit(dimension == nullptr ? "" : dimension->si_unit());
    for (const Literal& literal : literals()) {
      const std::string value = value_with_number(key, literal.text, unit);
      if (value.empty()) continue;
      // Text values with a unit use decimal numbers.
      if (key.type == vehd::ValueType::quantity && literal.text != fmt::format("{}", literal.value)) continue;
      const Reading reading = read(key, value);
      BOOST_TEST_CONTEXT(key.table << "." << key.name << " = " << value << "\n" << reading.refusal) {
        if (reading.number) {
          BOOST_TEST(*reading.number == literal.value);
          BOOST_TEST(key.accepts(*reading.number));
          ++read_count;
        } else {
          BOOST_TEST(reading.refusal.starts_with("scene.toml:2: "));
          BOOST_TEST(reading.refusal.find("; accepted: ") != std::string::npos);
          BOOST_TEST((!key.accepts(literal.value) || key.type == vehd::ValueType::integer));
        }
      }
    }
  }
  BOOST_TEST(read_count > 2000);
}

BOOST_AUTO_TEST_CASE(texts_with_a_unit_hold_the_same_numbers) {
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    const vehd::Dimension* dimension = vehd::find_dimension(key.unit);
    if (dimension == nullptr || key.type != vehd::ValueType::number) continue;
    for (const char* text : {"40500000000000000", "9007199254740993", "0.1", "3e-7"}) {
      const Reading reading = read(key, fmt::format("'{} {}'", text, dimension->si_unit()));
      BOOST_TEST(reading.number.value_or(std::nan("")) == std::strtod(text, nullptr), key.name << reading.refusal);
    }
  }
}

BOOST_AUTO_TEST_CASE(integers_beyond_the_digits_of_a_double_are_read_as_with_a_point) {
  const auto modulus = [](const std::string& value) {
    const vehd::Scene scene = parsed(with_appended("[membrane]\nbending_modulus = " + value + "\n"));
    BOOST_TEST((parsed(vehd::effective_scene(scene)) == scene));
    return *scene.membrane.bending_modulus;
  };
  BOOST_TEST(modulus("40500000000000000") == 4.05e16);
  BOOST_TEST(modulus("9007199254740993") == modulus("9007199254740993.0"));
  BOOST_TEST(message_of(with_appended("[membrane]\nbending_modulus = -40500000000000000\n")) ==
             "scene.toml:9: \"bending_modulus\" in [membrane] is -40500000000000000; accepted: a number >= 0");
  BOOST_TEST(
      message_of(with_appended("[membrane]\nbending_modulus = 9223372036854775808\n")).starts_with("scene.toml:9: "));
}

BOOST_AUTO_TEST_SUITE_END()
