#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "bie/scene/schema.hpp"
#include "tests/app/program.hpp"

BOOST_AUTO_TEST_SUITE(help, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(page_of_scene_keys_is_the_generated_one) {
  const ProgramResult result = run_vehd({"help", "scene", "--markdown"});
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST((result.output == file_text(std::string(VEHD_SOURCE_DIR) + "/docs/scene_keys.md")),
             "docs/scene_keys.md is not what vehd help scene --markdown prints");
}

BOOST_AUTO_TEST_CASE(scene_help_has_every_key_once_with_its_default) {
  const TemporaryDirectory directory;
  const ProgramResult result = run_vehd({"help", "scene", "--json", directory / "keys.json"});
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.errors.empty());
  const nlohmann::json keys = json_of(directory / "keys.json")["keys"];
  BOOST_TEST(keys.size() == vehd::scene_keys().size());
  for (const auto& key : keys) {
    for (const char* column : {"symbol", "type", "unit", "range", "default", "meaning"}) {
      BOOST_TEST(!key[column].get<std::string>().empty(), key["key"]);
    }
    if (key["key"] == "viscosity" && key["table"] == "fluid") {
      BOOST_TEST(key["default"] == "1.0; required with [units]");
    }
    if (key["key"] == "axes") BOOST_TEST(key["default"] == "required");
    if (key["key"] == "every") BOOST_TEST(key["default"] == "absent");
  }
  for (const vehd::TableDescription& table : vehd::scene_tables()) {
    BOOST_TEST(result.output.find(fmt::format("[{}]  ", table.name)) != std::string::npos, table.name);
  }
}

BOOST_AUTO_TEST_CASE(groups_of_a_scene_are_printed) {
  const TemporaryDirectory directory;
  write_text(directory / "scene.toml", quick_scene());
  const ProgramResult result =
      run_vehd({"help", "groups", directory / "scene.toml", "--json", directory / "groups.json"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST(result.output.find("electric capillary number") != std::string::npos, result.output);
  const nlohmann::json groups = json_of(directory / "groups.json")["groups"];
  BOOST_TEST(groups[1]["symbol"] == "v");
  BOOST_TEST(groups[1]["value"].get<double>() < 1.0);
}

BOOST_AUTO_TEST_CASE(help_alone_lists_the_topics_and_unknown_ones_are_refused) {
  BOOST_TEST(run_vehd({"help"}).output == run_vehd({"help", "--help"}).output);
  const ProgramResult result = run_vehd({"help", "scenes"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.output.empty());
  BOOST_TEST(std::count(result.errors.begin(), result.errors.end(), '\n') == 1, result.errors);
}

BOOST_AUTO_TEST_SUITE_END()
