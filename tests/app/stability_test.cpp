#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>

#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

const fs::path kScenes = fs::path(VEHD_SOURCE_DIR) / "tests/hard/scenes";

std::string with_criterion(const std::string& criterion) { return criterion + "\n" + quick_scene("1.0"); }

ProgramResult judged(const TemporaryDirectory& directory, const std::string& scene) {
  write_text(directory / "case.toml", scene);
  return run_vehd({"bench", "stability", directory / "case.toml", "-o", directory / "out", "--no-plot"});
}

}  // namespace

BOOST_AUTO_TEST_SUITE(stability, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

BOOST_AUTO_TEST_CASE(every_hard_case_holds_in_its_short_form) {
  const TemporaryDirectory directory;
  const ProgramResult result =
      run_vehd({"bench", "stability", kScenes.string(), "--quick", "-o", directory / "out", "--no-plot"});
  BOOST_TEST(result.exit_code == 0, result.output);
  const auto json = json_of(directory / "out/stability.json");
  const auto n_scenes = std::distance(fs::directory_iterator(kScenes), fs::directory_iterator());
  BOOST_TEST(json["rows"].size() == static_cast<std::size_t>(n_scenes));
  for (const auto& row : json["rows"]) {
    BOOST_TEST(row["verdict"].get<std::string>().starts_with("holds"), row["case"] << ": " << row["verdict"]);
  }
}

BOOST_AUTO_TEST_CASE(a_criterion_that_fails_is_reported) {
  const TemporaryDirectory directory;
  const std::string head = "#: family = \"f\"\n#: short_end_time = 1.0\n";
  const ProgramResult bound =
      judged(directory,
             with_criterion(head + "#: expect = \"completed\"\n#: most = { extent_z = 0.5, iterations_flow = 999 }"));
  BOOST_TEST(bound.exit_code == 4);
  BOOST_TEST(bound.output.find("FAILS: extent_z beyond its bound") != std::string::npos, bound.output);
  BOOST_TEST(judged(directory, with_criterion(head + "#: expect = \"stops\"")).output.find("goes on to its end") !=
             std::string::npos);
  BOOST_TEST(judged(directory, with_criterion(head + "#: expect = \"completed\"\n#: falls = [\"time\"]"))
                 .output.find("time rises beyond its bound") != std::string::npos);
  BOOST_TEST(judged(directory, with_criterion(head + "#: expect = \"completed\"\n#: steady = { time = 0.1 }"))
                 .output.find("time moves beyond its bound") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_wrong_criterion_is_one_clear_line) {
  const TemporaryDirectory directory;
  const auto message = [&](const std::string& criterion) {
    const ProgramResult result = judged(directory, with_criterion(criterion));
    BOOST_TEST(result.exit_code == 1);
    return result.errors;
  };
  BOOST_TEST(message("#: family = \"f\"\n#: wrong = 1").find("case.toml:2: unknown key \"wrong\"") !=
             std::string::npos);
  BOOST_TEST(message("#: family = \"f\"\n#: short_end_time = 1.0\n#: expect = \"luck\"")
                 .find("case.toml:3: \"luck\"; accepted: completed, flagged, stops") != std::string::npos);
  const std::string family = "#: family = \"f\"\n#: short_end_time = ", rest = "1.0\n#: expect = \"completed\"\n#: ";
  const auto has = [&](const std::string& criterion, const std::string& part) {
    const std::string text = message(criterion);
    BOOST_TEST(text.find("case.toml:" + part) != std::string::npos, text);
  };
  has(family + "\"soon\"\n#: expect = \"completed\"",
      "2: \"short_end_time\" is the text 'soon'; accepted: a finite number");
  has(family + rest + "most = 3", "4: \"most\" is 3; accepted: a table of columns and their bounds");
  has(family + rest + "most = { time = \"1\" }", "4: \"time\" is the text '1'; accepted: a finite number");
  has(family + rest + "falls = \"time\"", "4: \"falls\" is the text 'time'; accepted: a list of columns in quotes");
  has(family + rest + "falls = [3]", "4: \"falls\" is 3; accepted: a list of columns in quotes");
  has(family + rest + "steady = { time = true }", "4: \"time\" is true; accepted: a finite number");
  BOOST_TEST(message("# nothing").find("the criterion lacks a text \"family\"") != std::string::npos);
}

BOOST_AUTO_TEST_SUITE_END()
