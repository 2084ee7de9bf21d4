#include <boost/test/unit_test.hpp>

#include "tests/app/program.hpp"

namespace fs = std::filesystem;

namespace {

fs::path shipped(const std::string& name) { return fs::path(VEHD_SOURCE_DIR) / "docs/scenes" / (name + ".toml"); }

}  // namespace

BOOST_AUTO_TEST_SUITE(examples, *boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(are_listed_with_their_subjects) {
  const TemporaryDirectory directory;
  const ProgramResult result = run_vehd({"examples", "--json", directory / "list.json"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  const nlohmann::json examples = json_of(directory / "list.json")["examples"];
  BOOST_TEST(examples.size() == vehd::files_ending(fs::path(VEHD_SOURCE_DIR) / "docs/scenes", ".toml").size());
  for (const auto& example : examples) {
    BOOST_TEST(fs::exists(shipped(example["name"])), example["name"]);
    BOOST_TEST(result.output.find(example["title"].get<std::string>()) != std::string::npos, example["name"]);
  }
}

BOOST_AUTO_TEST_CASE(are_written_to_the_given_directory) {
  const TemporaryDirectory directory;
  const std::string go = "cd '" + (directory / "") + "' && '" VEHD_PROGRAM "' examples ";
  BOOST_TEST(run_command({"sh", "-c", go + "figure2 relaxation"}).output == "figure2.toml\nrelaxation.toml\n");
  for (const char* name : {"figure2", "relaxation"}) {
    BOOST_TEST(file_text(directory / (std::string(name) + ".toml")) == file_text(shipped(name)), name);
  }
  // Copying again does no harm.
  BOOST_TEST(run_command({"sh", "-c", go + "--all"}).exit_code == 0);
  BOOST_TEST(vehd::files_ending(directory / "", ".toml").size() ==
             vehd::files_ending(fs::path(VEHD_SOURCE_DIR) / "docs/scenes", ".toml").size());
  BOOST_TEST(run_command({"sh", "-c", go + "figure2 -o a/b --json -"}).output.find("a/b/figure2.toml") !=
             std::string::npos);
  BOOST_TEST(fs::exists(directory / "a/b/figure2.toml"));
}

BOOST_AUTO_TEST_CASE(never_replace_files_that_were_changed) {
  const TemporaryDirectory directory;
  const std::string file = directory / "figure3.toml";
  write_text(file, "mine");
  const ProgramResult result = run_vehd({"examples", "figure2", "figure3", "-o", directory / ""});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors == file + ": exists already and differs from the example; accepted: another folder (-o)\n");
  BOOST_TEST(file_text(file) == "mine");
  BOOST_TEST(!fs::exists(directory / "figure2.toml"));
}

BOOST_AUTO_TEST_CASE(unknown_ones_are_refused) {
  const ProgramResult result = run_vehd({"examples", "figure22"});
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.find("\"figure22\" is unknown; did you mean \"figure2\"?") != std::string::npos,
             result.errors);
}

BOOST_AUTO_TEST_SUITE_END()
