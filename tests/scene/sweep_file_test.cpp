#include "bie/scene/sweep_file.hpp"

#include <boost/test/unit_test.hpp>

#include "bie/support/errors.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

BOOST_AUTO_TEST_SUITE(sweep_file)

namespace {

/// A folder with a scene and a sweep of it.
struct SweepFolder {
  TemporaryDirectory directory;
  std::string file = directory / "some.toml";

  SweepFolder() { write_text(directory / "base.toml", quick_scene()); }

  vehd::SweepFile read(const std::string& text) {
    write_text(file, text);
    return vehd::read_sweep(file);
  }
  std::string refusal(const std::string& text) {
    try {
      static_cast<void>(read(text));
    } catch (const vehd::InputError& error) {
      const std::string message = error.what();
      return message.starts_with(file) ? message.substr(file.size()) : message;
    }
    return "accepted";
  }
};

std::vector<std::string> shown_values(const vehd::VariedKey& key) {
  std::vector<std::string> values;
  for (const vehd::VariedValue& value : key.values) values.push_back(value.shown);
  return values;
}

using Texts = std::vector<std::string>;

}  // namespace

BOOST_FIXTURE_TEST_CASE(the_last_key_of_a_grid_changes_first, SweepFolder) {
  const auto sweep = read(
      "scene = \"base.toml\"\n[vary]\n\"numerics.dt\" = {values = [0.5, 0.25]}\n"
      "electric.conductivity_in = {values = [1, 2.5, 3]}\n");
  BOOST_TEST(sweep.n_runs() == 6u);
  BOOST_TEST(sweep.keys[0].name == "numerics.dt");
  BOOST_TEST(sweep.keys[1].name == "electric.conductivity_in");
  BOOST_TEST(sweep.values_of(0)[1].toml == "1");
  BOOST_TEST(sweep.values_of(1)[1].toml == "2.5");
  BOOST_TEST(sweep.values_of(1)[0].toml == "0.5");
  BOOST_TEST(sweep.values_of(5)[0].toml == "0.25");
  BOOST_TEST(sweep.values_of(5)[1].toml == "3");
}

BOOST_FIXTURE_TEST_CASE(zip_takes_the_values_together, SweepFolder) {
  const std::string keys = "scene = \"base.toml\"\nmode = \"zip\"\n[vary]\n\"numerics.dt\" = {values = [0.5, 0.25]}\n";
  const auto sweep = read(keys + "\"electric.conductivity_in\" = {values = [1, 2]}\n");
  BOOST_TEST(sweep.n_runs() == 2u);
  BOOST_TEST(sweep.values_of(1)[0].toml == "0.25");
  BOOST_TEST(sweep.values_of(1)[1].toml == "2");
  BOOST_TEST(
      refusal(keys + "\"electric.conductivity_in\" = {values = [1, 2, 3]}\n") ==
      ":2: mode \"zip\": \"numerics.dt\" has 2 values and \"electric.conductivity_in\" has 3; accepted: as many");
}

BOOST_FIXTURE_TEST_CASE(ranges_have_both_their_ends_and_even_steps_or_factors, SweepFolder) {
  const auto sweep = read(
      "scene = \"base.toml\"\n[vary]\n\"numerics.dt\" = {from = 0.25, to = 1, count = 4}\n"
      "\"electric.conductivity_in\" = {from = 0.01, to = 100.0, count = 5, scale = \"log\"}\n"
      "\"numerics.degree\" = {from = 6, to = 12, count = 4}\n");
  BOOST_TEST(shown_values(sweep.keys[0]) == (Texts{"0.25", "0.5", "0.75", "1.0"}), boost::test_tools::per_element());
  BOOST_TEST(shown_values(sweep.keys[2]) == (Texts{"6", "8", "10", "12"}), boost::test_tools::per_element());
  BOOST_TEST(sweep.keys[1].is_logarithmic);
  BOOST_TEST(shown_values(sweep.keys[1]).front() == "0.01");
  BOOST_TEST(shown_values(sweep.keys[1]).back() == "100.0");
  BOOST_TEST(std::stod(shown_values(sweep.keys[1])[2]) == 1.0, boost::test_tools::tolerance(1e-14));
}

BOOST_FIXTURE_TEST_CASE(values_and_ranges_may_have_units, SweepFolder) {
  write_text(directory / "base.toml",
             quick_scene_with_units("length = \"10 um\"\ntime = \"1 ms\"\nviscosity = \"1 mPa s\"\n"));
  const auto sweep =
      read("scene = \"base.toml\"\n[vary]\n\"numerics.end_time\" = {from = \"1 ms\", to = \"3 ms\", count = 3}\n");
  BOOST_TEST(shown_values(sweep.keys[0]) == (Texts{"1.0 ms", "2.0 ms", "3.0 ms"}), boost::test_tools::per_element());
  BOOST_TEST(sweep.keys[0].values[1].toml == "\"2.0 ms\"");
  const auto mixed =
      read("scene = \"base.toml\"\n[vary]\n\"numerics.end_time\" = {from = \"1 ms\", to = \"3 s\", count = 2}\n");
  BOOST_TEST(shown_values(mixed.keys[0]) == (Texts{"1.0 ms", "3000.0 ms"}), boost::test_tools::per_element());
  BOOST_TEST(
      refusal("scene = \"base.toml\"\n[vary]\n\"numerics.end_time\" = {from = \"1 ms\", to = \"3 V\", count = 3}\n")
          .starts_with(":3: \"numerics.end_time\" in [vary] goes from a value in \"ms\" to one in \"V\""));
}

BOOST_FIXTURE_TEST_CASE(mistakes_are_said_with_line_and_nearest_name, SweepFolder) {
  const std::string start = "scene = \"base.toml\"\n[vary]\n";
  BOOST_TEST(refusal("scene = \"base.toml\"\n[vari]\n")
                 .starts_with(":2: unknown table \"vari\" in a sweep; did you mean \"vary\"?"));
  BOOST_TEST(refusal("[vary]\n") == ":1: missing key \"scene\" in a sweep; accepted: path of a scene");
  BOOST_TEST(refusal("scene = \"bass.toml\"\n[vary]\n") ==
             ":1: \"scene\" in a sweep is the text 'bass.toml': no such file");
  BOOST_TEST(refusal("scene = \"base.toml\"\n").starts_with(":1: missing table [vary]"));
  BOOST_TEST(refusal(start + "\"numerics.ddt\" = {values = [1]}\n") ==
             ":3: unknown key \"ddt\" of [numerics] in [vary]; did you mean \"dt\"?");
  BOOST_TEST(refusal(start + "\"dt\" = {values = [1]}\n")
                 .starts_with(":3: \"dt\" in [vary] is not a \"table.key\" of a scene; did you mean \""));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = 0.5\n").starts_with(":3: \"numerics.dt\" in [vary] is 0.5"));
  BOOST_TEST(refusal(start + "numerics.dt = 0.5\n").starts_with(":3: \"numerics.dt\" in [vary] is 0.5"));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {values = [1]}\nnumerics.dt = {values = [2]}\n")
                 .starts_with(":3: \"numerics.dt\" in [vary] is also at "));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {from = 0.1, count = 3}\n") ==
             ":3: missing key \"to\" in \"numerics.dt\" in [vary]; accepted: a number, or values = [...]");
  BOOST_TEST(
      refusal(start + "\"numerics.dt\" = {values = []}\n").starts_with(":3: \"numerics.dt\" in [vary] has no list"));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {valuse = [1]}\n")
                 .starts_with(":3: unknown key \"valuse\" in \"numerics.dt\" in [vary]; did you mean \"values\"?"));
  BOOST_TEST(
      refusal(start + "\"numerics.dt\" = {values = [0.5,\n  -1.0]}\n").starts_with(":4: \"dt\" in [numerics] is -1"));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {values = [\"fast\"]}\n").starts_with(":3: \"dt\" in [numerics]"));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {from = 0.1, to = 1.0}\n")
                 .starts_with(":3: \"numerics.dt\" in [vary] needs \"count\""));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {from = 0.0, to = 1.0, count = 3, scale = \"log\"}\n")
                 .starts_with(":3: \"numerics.dt\" in [vary] goes by equal factors"));
  BOOST_TEST(refusal(start + "\"numerics.degree\" = {from = 6, to = 11, count = 3}\n")
                 .starts_with(":3: \"numerics.degree\" in [vary] is a whole number and would become 8.5"));
  BOOST_TEST(
      refusal(start + "\"numerics.dt\" = {from = 0.1, to = 1.0, count = 3, scale = \"cubic\"}\n")
          .ends_with("\"scale\" in \"numerics.dt\" in [vary] is the text 'cubic'; accepted: \"linear\", \"log\""));
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {values = [0.5, 0.50]}\n")
                 .ends_with("has 0.5 twice; accepted: different values"));
  BOOST_TEST(refusal("mode = \"gird\"\nscene = \"base.toml\"\n[vary]\n\"numerics.dt\" = {values = [0.5]}\n") ==
             ":1: \"mode\" in a sweep is the text 'gird'; accepted: \"grid\", \"zip\"");
  BOOST_TEST(refusal(start + "\"numerics.dt\" = {from = 0.1, to = 1.0, count = 1000000000}\n").find("count") !=
             std::string::npos);
}

BOOST_FIXTURE_TEST_CASE(a_key_of_one_vesicle_is_varied_by_its_name, SweepFolder) {
  write_text(directory / "base.toml",
             quick_scene() + "[[vesicle]]\nname = \"soft\"\n[[vesicle]]\nname = \"stiff\"\nshape.centre = [5, 0, 0]\n");
  const auto sweep = read(
      "scene = \"base.toml\"\n[vary]\n\"vesicle.stiff.membrane.bending_modulus\" = {from = 1, to = 2, count = 2}\n");
  BOOST_TEST(shown_values(sweep.keys[0]) == (Texts{"1.0", "2.0"}), boost::test_tools::per_element());
  BOOST_TEST(sweep.keys[0].name == "vesicle.stiff.membrane.bending_modulus");
  BOOST_TEST(refusal("scene = \"base.toml\"\n[vary]\n\"vesicle.stif.membrane.bending_modulus\" = {values = [1]}\n")
                 .find("is not a \"table.key\" of a scene") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
