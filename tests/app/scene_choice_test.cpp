#include <boost/test/unit_test.hpp>

#include "bie/files/hdf5_reader.hpp"
#include "bie/scene/reader.hpp"
#include "tests/app/program.hpp"

namespace {

namespace fs = std::filesystem;

/// A folder with a quick scene in it, to work in.
struct WorkFolder {
  TemporaryDirectory directory;

  WorkFolder() { write_text(directory / "some.toml", quick_scene("0.5")); }

  [[nodiscard]] ProgramResult vehd(const std::string& arguments) const {
    return run_command({"sh", "-c", "cd '" + (directory / "") + "' && '" VEHD_PROGRAM "' " + arguments});
  }
  [[nodiscard]] nlohmann::json json(const std::string& file) const { return json_of(directory / file); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(scene_choice)

BOOST_FIXTURE_TEST_CASE(a_run_goes_to_a_folder_called_after_its_scene, WorkFolder) {
  const ProgramResult result = vehd("run some.toml --no-plot");
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST(fs::exists(directory / "out/some/summary.json"));
  BOOST_TEST(result.output.find("files: out/some\n") != std::string::npos, result.output);
  // Another run must not overwrite its files.
  BOOST_TEST(vehd("run some.toml --no-plot --set membrane.conductance=4").exit_code == 1);
}

BOOST_FIXTURE_TEST_CASE(a_run_uses_the_settings_and_its_scene_records_them, WorkFolder) {
  const ProgramResult result =
      vehd("run some.toml --no-plot --set numerics.end_time=0.25 --set membrane.conductance=4");
  BOOST_TEST(result.exit_code == 0, result.errors);
  const vehd::Scene scene = vehd::read_scene(directory / "out/some/scene.toml");
  BOOST_TEST(scene.numerics.end_time == 0.25);
  BOOST_TEST(scene.membrane.conductance == 4.0);
  BOOST_TEST(json("out/some/summary.json")["time"] == 0.25);
  // It continues only with the same settings.
  const ProgramResult other = vehd("run some.toml --resume --no-plot");
  BOOST_TEST(other.exit_code == 1);
  BOOST_TEST(other.errors.starts_with("some.toml:6: \"membrane.conductance\" is 5.0, but the run in out/some has 4.0"),
             other.errors);
  const ProgramResult changed = vehd("run some.toml --resume --no-plot --set membrane.conductance=3");
  BOOST_TEST(changed.errors.starts_with("--set membrane.conductance=3: \"membrane.conductance\" is 3.0, but"),
             changed.errors);
  BOOST_TEST(vehd("run some.toml --resume --no-plot --set membrane.conductance=4").exit_code == 0);
  BOOST_TEST(json("out/some/summary.json")["time"] == 0.5);
}

BOOST_FIXTURE_TEST_CASE(advice_about_a_stopped_run_repeats_the_settings, WorkFolder) {
  // An electric stress that is too large for steps of this size.
  const ProgramResult result =
      vehd("run some.toml --no-plot --set 'electric.field=[0, 0, 1e5]' --set numerics.end_time=1e3");
  BOOST_TEST(result.exit_code == 3, result.output << result.errors);
  BOOST_TEST(result.errors.find("vehd run some.toml --set 'electric.field=[0, 0, 1e5]' --set numerics.end_time=1e3 -o "
                                "out/some --resume") != std::string::npos,
             result.errors);
}

BOOST_FIXTURE_TEST_CASE(plan_and_run_refuse_a_wrong_setting_in_one_line, WorkFolder) {
  for (const std::string command : {"run", "plan", "check"}) {
    const ProgramResult result = vehd(command + " some.toml --set membrane.condutance=4");
    if (command == "check" && result.errors.find("finite-element") != std::string::npos) continue;
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(
        result.errors ==
        "--set membrane.condutance=4: unknown key \"condutance\" in [membrane]; did you mean \"conductance\"?\n");
    BOOST_TEST(result.output == "");
  }
  BOOST_TEST(!fs::exists(directory / "out"));
}

BOOST_FIXTURE_TEST_CASE(a_plan_follows_the_settings, WorkFolder) {
  const auto unknowns = [&](const std::string& settings) {
    BOOST_TEST_REQUIRE(vehd("plan some.toml --json plan.json " + settings).exit_code == 0);
    return json("plan.json")["unknowns"].get<int>();
  };
  BOOST_TEST(unknowns("") < unknowns("--set numerics.degree=8"));
  BOOST_TEST(unknowns("--set numerics.order=8") == unknowns("--set numerics.degree=8"));
}

BOOST_FIXTURE_TEST_CASE(threads_are_those_of_the_command, WorkFolder) {
  for (const int threads : {1, 2}) {
    const std::string number = std::to_string(threads);
    BOOST_TEST(vehd("run some.toml --no-plot -o " + number + " --threads " + number).exit_code == 0);
    BOOST_TEST(::vehd::Hdf5Reader(directory / number + "/run.h5").integer_attribute("/", "threads") == threads);
  }
  BOOST_TEST(vehd("run some.toml --threads 0").exit_code == 1);
}

BOOST_AUTO_TEST_SUITE_END()
