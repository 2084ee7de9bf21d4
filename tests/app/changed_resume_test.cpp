#include <boost/test/unit_test.hpp>
#include <nlohmann/json.hpp>
#include <regex>

#include "bie/files/run_reader.hpp"
#include "bie/sphere/harmonics.hpp"
#include "tests/app/reference_run.hpp"
#include "tests/app/stopping_scenes.hpp"

namespace {

/// A run in one directory whose scene is edited between the sessions.
struct EditedRun {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string output = directory / "out";
  std::string text;

  explicit EditedRun(std::string start) : text(std::move(start)) {}

  /// Replaces the value of a key, wherever a line sets it.
  void set(const std::string& key, const std::string& value) {
    text = std::regex_replace(text, std::regex("\n" + key + " = [^\n]*"), "\n" + key + " = " + value);
  }

  [[nodiscard]] ProgramResult session() const {
    write_text(scene, text);
    return run_vehd({"run", scene, "-o", output, "--resume", "--no-plot", "--quiet"});
  }
  void finish() const {
    const ProgramResult result = session();
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }
  [[nodiscard]] nlohmann::json summary() const { return json_of(output + "/summary.json"); }
};

/// Degrees in the rows of a history, with consecutive repetitions removed.
std::vector<int> degrees(const std::string& history) {
  std::istringstream lines(file_text(history));
  std::string line;
  std::getline(lines, line);
  const auto count = [](const std::string& part) { return std::count(part.begin(), part.end(), ','); };
  const auto column = count(line.substr(0, line.find(",order,"))) + 1;
  std::vector<int> result;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (std::ptrdiff_t i = 0; i <= column; ++i) std::getline(cells, cell, ',');
    if (result.empty() || result.back() != std::stoi(cell)) result.push_back(std::stoi(cell));
  }
  return result;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(changed_resume)

BOOST_AUTO_TEST_CASE(where_no_step_is_acceptable_a_smaller_one_may_be) {
  EditedRun run(sudden_shear);
  const ProgramResult stopped = run.session();
  BOOST_TEST(stopped.exit_code == 3);
  BOOST_TEST(stopped.output.find("verdict: stopped: no acceptable step from time 1: ") != std::string::npos,
             stopped.output);
  BOOST_TEST(stopped.errors.find("change dt (now 0.25), degree (now 6)") != std::string::npos, stopped.errors);
  BOOST_TEST(stopped.errors.find("continue with: vehd run ") != std::string::npos, stopped.errors);
  BOOST_TEST(run.summary()["verdict"].get<std::string>().starts_with("stopped: no acceptable step from time 1: "));
  BOOST_TEST(run.summary()["changes"].empty());
  const std::string history = file_text(run.output + "/history.csv");
  BOOST_TEST(run.session().errors == stopped.errors);

  run.set("dt", "1e-6");
  run.set("end_time", "1.00002");
  run.finish();
  BOOST_TEST(file_text(run.output + "/history.csv").starts_with(history));
  const nlohmann::json summary = run.summary();
  BOOST_TEST(summary["completed"].get<bool>());
  BOOST_TEST(!summary["verdict"].get<std::string>().starts_with("stopped"));
  const nlohmann::json change = {{"time", 1.0}, {"step", 4}, {"key", "numerics.dt"}, {"from", 0.25}, {"to", 1e-6}};
  BOOST_TEST((summary["changes"] == nlohmann::json::array({change})), summary["changes"].dump());
  const std::string line = "# changed at time 1 (step 4): numerics.dt = 1e-06, before 0.25\n";
  BOOST_TEST(file_text(run.output + "/scene.toml").starts_with(line));
  BOOST_TEST(vehd::RunReader(run.output + "/run.h5").scene().starts_with(line));
}

BOOST_AUTO_TEST_CASE(where_no_step_is_acceptable_a_tolerance_may_find_one) {
  EditedRun run(sudden_shear);
  BOOST_TEST(run.session().exit_code == 3);
  run.set("dt", "0.25\ntolerance = 0.01");
  run.set("end_time", "1.00002");
  run.finish();
  std::vector<std::string> keys;
  const nlohmann::json summary = run.summary();
  for (const auto& change : summary["changes"]) keys.push_back(change["key"]);
  BOOST_TEST((keys == std::vector<std::string>{"numerics.tolerance", "numerics.time_order"}),
             summary["changes"].dump());
  BOOST_TEST(summary["changes"][0]["from"].is_null());
}

BOOST_AUTO_TEST_CASE(degree_may_rise_and_fall_and_no_snapshot_loses_a_digit) {
  EditedRun run(quick_scene("1.0"));
  run.finish();
  const auto snapshot = [&](std::size_t number, const std::string& field) {
    return vehd::RunReader(run.output + "/run.h5").snapshot(number).coefficients(field);
  };
  const std::vector<std::string> fields = {"x", "Vm", "velocity", "force_bending", "force_electric", "tension", "q"};
  std::vector<vehd::Matrix> before;
  for (const std::string& field : fields) before.push_back(snapshot(2, field));

  run.set("order", "9");
  run.set("end_time", "2.0");
  run.finish();
  for (std::size_t i = 0; i < fields.size(); ++i) {
    BOOST_TEST((snapshot(2, fields[i]) == vehd::resize_order(before[i], 9)), fields[i]);
  }
  BOOST_TEST(run.summary()["verdict"].get<std::string>() == "trustworthy");
  run.set("order", "5");
  run.set("end_time", "3.0");
  run.finish();
  BOOST_TEST(degrees(run.output + "/history.csv") == (std::vector<int>{6, 9, 5}), boost::test_tools::per_element());

  // All snapshots share one grid, and the readers of runs accept the file.
  const vehd::Hdf5Reader file(run.output + "/run.h5");
  BOOST_TEST(file.vector("/grid/theta").size() == 10);
  for (const std::string& name : file.members("/snapshots")) {
    BOOST_TEST(file.matrix("/snapshots/" + name + "/x").rows() == 10 * 20);
    // Each snapshot is intact and keeps the degree in which it was solved.
    const vehd::RunReader run_file(run.output + "/run.h5");
    const vehd::RunSnapshot stored = run_file.snapshot(std::stoul(name));
    const double time = stored.time();
    BOOST_TEST(stored.degree() == (time < 1.1 ? 6 : time < 2.1 ? 9 : 5), time);
  }
  BOOST_TEST(run_vehd({"plot", run.output}).exit_code == 0);
  BOOST_TEST(run.summary()["changes"].size() == 2U);
}

BOOST_AUTO_TEST_CASE(a_run_that_was_changed_resumes_bit_for_bit) {
  EditedRun run(quick_scene("1.0"));
  run.finish();
  const std::string copy = run.directory / "copy";
  run.set("order", "8");
  run.set("time_order", "2");
  run.set("end_time", "3.0");
  std::filesystem::copy(run.output, copy, std::filesystem::copy_options::recursive);
  run.finish();
  const std::string whole = std::exchange(run.output, copy);
  run.set("end_time", "2.0");
  run.finish();
  run.set("end_time", "3.0");
  run.finish();
  check_same_run(run.output, whole);
  BOOST_TEST(file_text(run.output + "/scene.toml") == file_text(whole + "/scene.toml"));
}

BOOST_AUTO_TEST_CASE(a_change_before_the_first_step_starts_anew) {
  EditedRun run(stopping_scene);
  BOOST_TEST(run.session().exit_code == 3);
  run.set("dt", "0.25");
  run.set("order", "8");
  run.set("end_time", "1.0");
  run.set("every", "0.5");
  run.finish();
  BOOST_TEST(run.summary()["changes"].size() == 2U);
  BOOST_TEST(run.summary()["changes"][0]["time"].get<double>() == 0.0);
  const std::string resumed = std::exchange(run.output, run.directory / "fresh");
  run.finish();
  check_same_run(resumed, run.output);
}

BOOST_AUTO_TEST_CASE(symmetry_may_be_given_up_but_not_assumed) {
  EditedRun run(quick_scene("1.0"));
  run.finish();
  run.set("dt", "0.25\nsymmetry = \"off\"");
  run.set("end_time", "1.5");
  run.finish();
  BOOST_TEST(run.summary()["changes"][0]["to"].get<std::string>() == "off");
  run.set("symmetry", "\"auto\"");
  run.set("end_time", "2.0");
  const ProgramResult result = run.session();
  BOOST_TEST(result.exit_code == 1);
  BOOST_TEST(result.errors.starts_with(run.scene + ":14: \"numerics.symmetry\" is \"auto\", but the run in " +
                                       run.output + " has \"off\"; "),
             result.errors);
}

BOOST_AUTO_TEST_CASE(other_physics_are_refused_by_name_and_line) {
  EditedRun run(quick_scene("1.0"));
  run.finish();
  const std::string history = file_text(run.output + "/history.csv");
  const auto refused = [&](const std::string& key, const std::string& value, const std::string& message) {
    const std::string good = run.text;
    run.set(key, value);
    run.set("dt", "0.1");
    const ProgramResult result = run.session();
    run.text = good;
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors.starts_with(run.scene + message), result.errors);
    BOOST_TEST(file_text(run.output + "/history.csv") == history);
  };
  const std::string but = ", but the run in " + run.output + " has ";
  refused("bending_modulus", "0.2", ":5: \"membrane.bending_modulus\" is 0.2" + but + "0.1; ");
  // A key that the scene of the run leaves out has its default value; with its whole table left out it is absent.
  refused("conductance", "5.0\ncapacitance = 2.0", ":7: \"membrane.capacitance\" is 2.0" + but + "1.0; ");
  refused("axes", "[1.0, 1.0, 1.25]", ":3: \"shape.axes\" is [1.0, 1.0, 1.25]" + but + "[1.0, 1.0, 1.5]; ");
  refused("every", "0.5\n[flow]\nkind = \"shear\"\nrate = 2.0", ":18: \"flow.kind\" is \"shear\"" + but + "absent; ");
  run.set("end_time", "0.5");
  BOOST_TEST(run.session().errors.starts_with(run.scene + ":14: \"numerics.end_time\" is 0.5" + ", but the run in " +
                                              run.output + " has already reached 1"));
}

BOOST_AUTO_TEST_CASE(complete_run_has_nothing_to_do_whatever_its_steps_would_be) {
  EditedRun run(quick_scene("1.0"));
  run.finish();
  run.set("dt", "0.1");
  const ProgramResult result = run.session();
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.output.find("nothing to do") != std::string::npos);
  BOOST_TEST(run.summary()["changes"].empty());
}

BOOST_AUTO_TEST_SUITE_END()
