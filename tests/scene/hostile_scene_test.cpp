#include <fmt/format.h>

#include <boost/test/unit_test.hpp>

#include "bie/scene/schema.hpp"
#include "tests/scene/key_values.hpp"
#include "tests/scene/scene_text.hpp"
#include "tests/support/files.hpp"

BOOST_AUTO_TEST_SUITE(hostile_scene)

namespace {

/// A scene that is in order but for `key`, which has this value; the table of the key holds nothing else that is read
/// before.
std::string scene_with(const vehd::KeyDescription& key, const std::string& value) {
  const std::string table(key.table);
  std::string text;
  const auto add_unless_own = [&](const std::string& name, const std::string& content) {
    if (table != name) text += "[" + name + "]\n" + content;
  };
  add_unless_own("shape", "kind = 'ellipsoid'\naxes = [1, 1, 2]\n");
  add_unless_own("numerics", "dt = 1\nend_time = 1\n");
  if (table == "flow.waveform") add_unless_own("flow", "kind = 'shear'\nrate = 1\n");
  if (table == "membrane.pump.waveform") add_unless_own("membrane.pump", "kind = 'harmonics'\ncurrent = 1\n");
  if (table == "electric.waveform") {
    add_unless_own("electric", "field = [0, 0, 1]\nconductivity_in = 1\nconductivity_out = 1\n");
  }
  text += "[" + table + "]\n";
  if (!key.kinds.empty()) {
    text += std::string(vehd::kind_key(table)->name) + " = '" + std::string(key.kinds.front()) + "'\n";
  } else if (table == "shape") {
    text += "kind = 'ellipsoid'\naxes = [1, 1, 2]\n";
  } else if (table == "suspension") {
    text += "kind = 'ball'\nradius = 9\n";
  }
  return text + std::string(key.name) + " = " + value + "\n";
}

std::string numerics(const std::string& text) {
  return "[shape]\nkind = 'ellipsoid'\naxes = [1, 1, 2]\n[numerics]\n" + text;
}

}  // namespace

BOOST_AUTO_TEST_CASE(no_key_takes_what_is_not_a_finite_number) {
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

BOOST_AUTO_TEST_CASE(sizes_that_no_machine_has_are_refused) {
  BOOST_TEST(message_of(numerics("dt = 1\nend_time = 1e12\n")) ==
             "scene.toml:5: end_time / dt in [numerics] asks for 1e+12 steps; accepted: at most 1e+09");
  BOOST_TEST(message_of(numerics("dt = 1e-300\nend_time = 1e300\n")) ==
             "scene.toml:5: end_time / dt in [numerics] asks for inf steps; accepted: at most 1e+09");
  BOOST_TEST(message_of(numerics("dt = 1e-3\nend_time = 1\n[output]\nevery = 1e-12\n")) ==
             "scene.toml:8: \"every\" in [output] asks for 1e+12 snapshots; accepted: at most 999999");
  BOOST_TEST(message_of(numerics("tolerance = 1e-3\nend_time = 1e300\n[output]\nevery = 1\n")) ==
             "scene.toml:8: \"every\" in [output] asks for 1e+300 snapshots; accepted: at most 999999");
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
  // Holes take no room.
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
}

BOOST_AUTO_TEST_SUITE_END()
