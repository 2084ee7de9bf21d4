#include <boost/test/unit_test.hpp>

#include "tests/app/program.hpp"
#include "tests/estimate/kept_costs.hpp"

BOOST_AUTO_TEST_SUITE(cost_table)

BOOST_AUTO_TEST_CASE(command_reads_what_the_last_call_has_kept_unless_told_otherwise) {
  const TemporaryDirectory directory;
  const OwnCache own;
  write_text(directory / "scene.toml", quick_scene("1.0"));
  const auto read_by_command = [&](const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"plan", "--menu", directory / "scene.toml", "--json", directory / "costs.json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramResult result = run_vehd(arguments);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    BOOST_TEST(result.errors.empty(), result.errors);
    return json_of(directory / "costs.json");
  };
  const nlohmann::json rows = read_by_command();
  BOOST_TEST(rows.size() == 7);
  BOOST_TEST((read_by_command() == rows));
  forge(own.file());
  BOOST_TEST(read_by_command()[0]["steps"].get<int>() == kForged);
  BOOST_TEST(read_by_command({"--fresh"})[0]["steps"].get<int>() != kForged);
}

BOOST_AUTO_TEST_SUITE_END()
