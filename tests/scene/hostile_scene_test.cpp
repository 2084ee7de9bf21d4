#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cmath>

#include "bie/scene/schema.hpp"
#include "tests/scene/key_values.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(hostile_scene)

namespace {

std::string numerics(const std::string& text) {
  return "[shape]\nkind = 'ellipsoid'\naxes = [1, 1, 2]\n[numerics]\n" + text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_key_refuses_numbers_that_are_not_finite) {
  int count = 0;
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    for (const char* number : {"nan", "inf", "-inf"}) {
      const std::string value = value_with_number(key, number);
      if (value.empty()) continue;
      const std::string text = scene_with(key, value);
      const std::string message = message_of(text);
      const std::string name = fmt::format("\"{}\" in [{}]", key.name, key.table);
      BOOST_TEST_CONTEXT(text << message) {
        BOOST_TEST(message.starts_with("scene.toml:"));
        BOOST_TEST(message.find(name) != std::string::npos);
        BOOST_TEST(message.find(number, message.find(name)) != std::string::npos);
        BOOST_TEST(message.find("; accepted: ") != std::string::npos);
      }
      ++count;
    }
  }
  BOOST_TEST(count > 100);
}

BOOST_AUTO_TEST_CASE(numbers_beyond_the_largest_are_refused) {
  for (const std::string number : {"1e999", "-1e999"}) {
    const std::string message = message_of(numerics("dt = 1\nend_time = " + number + "\n"));
    BOOST_TEST(message.starts_with("scene.toml:6: "), message);
  }
  BOOST_TEST(message_of(numerics("dt = '1e999 s'\nend_time = 1\n")).starts_with("scene.toml:5: \"dt\" in [numerics]"));
}

// Squares and products of such numbers underflow or overflow.
BOOST_AUTO_TEST_CASE(numbers_whose_powers_no_number_holds_are_refused) {
  int count = 0;
  for (const vehd::KeyDescription& key : vehd::scene_keys()) {
    if (key.type == vehd::ValueType::integer) continue;
    for (const char* number : {"1e308", "1e200", "1e-200", "1e-308", "5e-324"}) {
      const std::string value = value_with_number(key, number);
      const bool is_long_time = key.unit == "time" && std::string(number).find('-') == std::string::npos;
      if (value.empty() || is_long_time) continue;
      const std::string message = message_of(scene_with(key, value));
      const std::string name = fmt::format("\"{}\" in [{}]", key.name, key.table);
      BOOST_TEST_CONTEXT(key.table << "." << key.name << " = " << value << ": " << message) {
        BOOST_TEST(message.starts_with("scene.toml:"));
        BOOST_TEST(message.find(name) != std::string::npos);
        BOOST_TEST(message.find("; accepted: ") != std::string::npos);
      }
      ++count;
    }
  }
  BOOST_TEST(count > 200);
  BOOST_TEST(message_of(numerics("dt = 1\nend_time = 1\n[flow]\nkind = 'shear'\nrate = 1e200\n")) ==
             "scene.toml:9: \"rate\" in [flow] is 1e+200; accepted: any finite number, 1e-50 ... 1e+50 in "
             "magnitude unless 0");
  BOOST_TEST(message_of(numerics("dt = 1e-200\nend_time = 1\n")) ==
             "scene.toml:5: \"dt\" in [numerics] is 1e-200; accepted: a number > 0, at least 1e-50 in magnitude "
             "unless 0");
}

// The same check with units: for a value, for a scale and for their combination.
BOOST_AUTO_TEST_CASE(quantities_whose_powers_no_number_holds_are_refused) {
  const auto message = [](const std::string& scales, const std::string& rest) {
    return message_of("[units]\n" + scales + numerics("dt = 1\nend_time = 1\n[fluid]\nviscosity = 1\n" + rest));
  };
  BOOST_TEST(message("length = '1e-200 m'\n", "").starts_with("scene.toml:2: \"length\" in [units] is "));
  BOOST_TEST(message("time = '1 s'\n", "[flow]\nkind = 'shear'\nrate = '1e200 1/s'\n")
                 .starts_with("scene.toml:13: \"rate\" in [flow] is "));
  BOOST_TEST(message("time = '1e-40 s'\n", "[flow]\nkind = 'shear'\nrate = '1e-40 1/s'\n")
                 .starts_with("scene.toml:13: \"rate\" in [flow] is "));
  const std::string electric = "[membrane]\ncapacitance = 1\n[electric]\nfield = [0, 0, 1]\npermittivity = 1\n";
  BOOST_TEST(
      message("length = '1e50 m'\ntime = '1e-50 s'\nviscosity = '1e50 Pa s'\npotential = '1e-50 V'\n",
              electric + "conductivity_in = '1 S/m'\nconductivity_out = 1\n")
          .starts_with("scene.toml:19: \"conductivity_in\" in [electric] is the text '1 S/m', but 1 of the scene "
                       "is inf S/m"));
}

BOOST_AUTO_TEST_CASE(a_negative_zero_is_zero) {
  const vehd::Scene scene =
      parsed(numerics("dt = 1\nend_time = -0.0\n[electric]\nfield = [0, -0.0, 1]\n"
                      "conductivity_in = -0.0\nconductivity_out = 1\n"));
  for (const double value : {scene.numerics.end_time, scene.electric->field[1], scene.electric->conductivity_in}) {
    BOOST_TEST(value == 0.0);
    BOOST_TEST(!std::signbit(value));
  }
}

// One rule for all sources of steps.
BOOST_AUTO_TEST_CASE(steps_that_no_run_takes_are_refused) {
  const std::string field = "[electric]\nfield = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 2\n";
  const auto message = [&](const std::string& keys, const std::string& waveform) {
    return message_of(numerics(keys + "end_time = 1\n" + field + "[electric.waveform]\n" + waveform));
  };
  const std::string train = "kind = 'pulse_train'\nduration = 1e-12\nperiod = 2e-12\n",
                    ac = "kind = 'ac'\nfrequency = ";
  for (const char* keys : {"tolerance = 1e-3\n", "dt = 0.1\n"}) {
    BOOST_TEST(message(keys, train) ==
               "scene.toml:14: \"period\" in [electric.waveform] makes 1e+12 steps; accepted: at most 1e+09");
  }
  BOOST_TEST(message("tolerance = 1e-3\n", ac + "1e12\n") ==
             "scene.toml:13: \"frequency\" in [electric.waveform] makes 8e+12 steps; accepted: at most 1e+09");
  BOOST_TEST(message("tolerance = 1e-3\ndt = 1e-12\n", "kind = 'dc'\n") ==
             "scene.toml:6: \"dt\" in [numerics] makes 1e+12 steps; accepted: at most 1e+09");
  BOOST_TEST(message("tolerance = 1e-3\n", ac + "1e8\n") == "");
  BOOST_TEST(message("tolerance = 1e-3\n", ac + "1e12\naverage = true\n") == "");
}

BOOST_AUTO_TEST_CASE(sizes_that_no_machine_has_are_refused) {
  BOOST_TEST(message_of(numerics("dt = 1\nend_time = 1e12\n")) ==
             "scene.toml:5: \"dt\" in [numerics] makes 1e+12 steps; accepted: at most 1e+09");
  BOOST_TEST(message_of(numerics("dt = 1e-50\nend_time = 1e300\n")) ==
             "scene.toml:5: \"dt\" in [numerics] makes inf steps; accepted: at most 1e+09");
  BOOST_TEST(message_of(numerics("dt = 1e-3\nend_time = 1\n[output]\nevery = 1e-12\n")) ==
             "scene.toml:8: \"every\" in [output] makes 1e+12 snapshots; accepted: at most 999999");
  BOOST_TEST(message_of(numerics("tolerance = 1e-3\nend_time = 1e300\n[output]\nevery = 1\n")) ==
             "scene.toml:8: \"every\" in [output] makes 1e+300 snapshots; accepted: at most 999999");
  BOOST_TEST(message_of(numerics("dt = 1\nend_time = 1\norder = 9223372036854775807\n")) ==
             "scene.toml:7: \"order\" in [numerics] is 9223372036854775807; accepted: an integer, 4 ... 64");
  BOOST_TEST(message_of("[shape]\nkind = 'radial'\nmodes = [{n = 1000000000, m = 0, a = 1}]\n")
                 .starts_with("scene.toml:3: \"modes\" in [shape] has the degree n = 1000000000; accepted: "));
}

BOOST_AUTO_TEST_CASE(files_of_a_terabyte_are_refused_unread) {
  const TemporaryDirectory directory;
  const auto message = [&](const std::string& name) {
    try {
      vehd::read_scene(directory / name);
    } catch (const vehd::InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  // A sparse file occupies no disk space.
  write_text(directory / "large.toml", "");
  std::filesystem::resize_file(directory / "large.toml", std::uintmax_t{1} << 40);
  BOOST_TEST(message("large.toml") ==
             directory / "large.toml" +
                 ": 1099511627776 bytes are too many for a scene file; accepted: at most 1048576");
  write_text(directory / "scene.toml",
             numerics("dt = 1\nend_time = 1\n[flow]\nkind = 'shear'\nrate = 1\n[flow.waveform]\nkind = 'table'\n"
                      "path = 'large.toml'\n"));
  BOOST_TEST(message("scene.toml") ==
             directory / "large.toml" + ": 1099511627776 bytes are too many for a waveform; accepted: at most 4194304");
}

BOOST_AUTO_TEST_CASE(deep_nesting_is_refused) {
  for (const std::string part : {"a.", "\"a,\".", "[", "{a="}) {
    std::string text;
    for (int depth = 0; depth < 100000; ++depth) text += part;
    BOOST_TEST(message_of("x = " + text + "\n").starts_with("scene.toml:1: "));
    BOOST_TEST(message_of(text + "b = 1\n").starts_with("scene.toml:1: "));
    BOOST_TEST(message_of("[" + text + "b]\n").starts_with("scene.toml:1: "));
  }
  BOOST_TEST(message_of("# " + std::string(100, '.') + "\n" + numerics("dt = 1\nend_time = 1\n")) == "");
}

BOOST_AUTO_TEST_SUITE_END()
