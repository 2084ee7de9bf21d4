#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "bie/scene/hdf5_reader.hpp"
#include "tests/app/program.hpp"

namespace {

const std::vector<std::string> numeric_datasets = {"x",  "velocity", "force_bending", "force_tension", "force_electric",
                                                   "Vm", "q",        "tension",       "area_element"};

/// All numbers of all snapshots, with their times.
std::vector<std::pair<std::string, vehd::Vector>> snapshot_data(const std::string& path) {
  const vehd::Hdf5Reader file(path);
  std::vector<std::pair<std::string, vehd::Vector>> data;
  for (const std::string& name : file.members("/snapshots")) {
    const std::string group = "/snapshots/" + name;
    data.emplace_back(group, vehd::Vector::Constant(1, file.number_attribute(group, "time")));
    for (const std::string& field : numeric_datasets) {
      data.emplace_back(group + "/" + field, file.vector(group + "/" + field));
    }
    for (const std::string& field : file.members(group + "/coefficients")) {
      data.emplace_back(field, file.vector(group + "/coefficients/" + field));
    }
    for (const std::string& field : file.members(group + "/surface")) {
      data.emplace_back(field, file.vector(group + "/surface/" + field));
    }
  }
  return data;
}

void check_same_run(const std::string& actual, const std::string& expected) {
  BOOST_TEST((file_text(actual + "/history.csv") == file_text(expected + "/history.csv")));
  const auto data = snapshot_data(actual + "/run.h5"), reference = snapshot_data(expected + "/run.h5");
  BOOST_TEST_REQUIRE(data.size() == reference.size());
  for (std::size_t i = 0; i < data.size(); ++i) {
    BOOST_TEST(data[i].first == reference[i].first);
    BOOST_TEST((data[i].second.array() == reference[i].second.array()).all(), data[i].first);
  }
  BOOST_TEST((file_text(actual + "/run.xdmf") == file_text(expected + "/run.xdmf")));
}

struct ReferenceRun {
  TemporaryDirectory directory;
  std::string scene = directory / "scene.toml";
  std::string reference = directory / "reference";
  std::string output = directory / "out";
  std::vector<std::string> command = vehd_command({"run", scene, "-o", output, "--resume", "--no-plot"});
  double seconds = 0.0;

  explicit ReferenceRun(const std::string& text = quick_scene()) {
    write_text(scene, text);
    const auto start = std::chrono::steady_clock::now();
    const ProgramResult result = run_vehd({"run", scene, "-o", reference, "--no-plot"});
    seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
  }

  void finish() const {
    const ProgramResult result = run_command(command);
    BOOST_TEST_REQUIRE(result.exit_code == 0, result.errors);
    BOOST_TEST(!std::filesystem::exists(output + "/.run.h5.spare"));
  }

  /// Waits until the run has written at least one row.
  void wait_for_rows(RunningProgram& program) const {
    while (!program.ended() && file_text(output + "/history.csv").size() < 1000) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
};

/// Long enough to be met while it runs.
struct LongRun : ReferenceRun {
  LongRun() : ReferenceRun(quick_scene("60.0")) {}
};

/// Steps and degrees of its own choice.
struct AdaptiveRun : ReferenceRun {
  AdaptiveRun() : ReferenceRun(scene_text()) {}

  static std::string scene_text() {
    std::string text = quick_scene("6.0");
    const std::string fixed = "order = 6\ndt = 0.25";
    return text.replace(text.find(fixed), fixed.size(), "tolerance = 1e-3");
  }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(resume)

BOOST_AUTO_TEST_CASE(a_chain_of_fifty_runs_is_one_run) {
  // Every link takes one step of 0.25 and ends; its end is a snapshot of its own, so histories are compared.
  constexpr int kLinks = 50;
  const ReferenceRun one(quick_scene("12.5"));
  for (int link = 1; link <= kLinks; ++link) {
    write_text(one.scene, quick_scene(std::to_string(0.25 * link)));
    one.finish();
  }
  BOOST_TEST((file_text(one.output + "/history.csv") == file_text(one.reference + "/history.csv")));
  BOOST_TEST(
      (snapshot_data(one.output + "/run.h5").back().second == snapshot_data(one.reference + "/run.h5").back().second));
}

BOOST_FIXTURE_TEST_CASE(killed_at_random_moments_reproduces_every_bit, ReferenceRun) {
  std::mt19937 random(20240607);
  for (int trial = 0; trial < 6; ++trial) {
    std::filesystem::remove_all(output);
    // Several kills in a row, each at some part of what is left.
    for (int kill = 0; kill < 3; ++kill) {
      RunningProgram program(command);
      std::this_thread::sleep_for(std::chrono::duration<double>(seconds * (random() % 1000) / 1000.0));
      program.send(SIGKILL);
      program.wait();
      // Whatever is there under the final name is complete and readable.
      if (std::filesystem::exists(output + "/run.h5")) vehd::Hdf5Reader(output + "/run.h5");
    }
    finish();
    check_same_run(output, reference);
  }
}

BOOST_FIXTURE_TEST_CASE(killed_run_with_a_tolerance_reproduces_every_bit, AdaptiveRun) {
  for (const double part : {0.3, 0.6, 0.9}) {
    std::filesystem::remove_all(output);
    RunningProgram program(command);
    std::this_thread::sleep_for(std::chrono::duration<double>(part * seconds));
    program.send(SIGKILL);
    program.wait();
    finish();
    check_same_run(output, reference);
  }
}

BOOST_FIXTURE_TEST_CASE(killed_while_files_are_written_reproduces_every_bit, ReferenceRun) {
  for (const char* moment : {"/.run.h5.old", "/.checkpoint.h5.new", "/.run.xdmf.new", "/.run.h5.new"}) {
    std::filesystem::remove_all(output);
    RunningProgram program(command);
    while (!program.ended() && !std::filesystem::exists(output + moment)) {
    }
    program.send(SIGKILL);
    program.wait();
    finish();
    check_same_run(output, reference);
  }
}

BOOST_FIXTURE_TEST_CASE(interrupt_leaves_a_resumable_run, LongRun) {
  for (const int signal : {SIGINT, SIGTERM}) {
    std::filesystem::remove_all(output);
    RunningProgram program(command);
    wait_for_rows(program);
    program.send(signal);
    const ProgramResult result = program.wait();
    BOOST_TEST(result.exit_code == 3);
    BOOST_TEST(result.errors.find("continue with: vehd run ") != std::string::npos, result.errors);
    const auto summary = nlohmann::json::parse(file_text(output + "/summary.json"));
    BOOST_TEST(!summary.at("completed").get<bool>());
    finish();
    check_same_run(output, reference);
  }
}

// Checking a radial scene starts threads; these must not take the signal either.
BOOST_FIXTURE_TEST_CASE(interrupt_of_a_radial_scene_is_orderly, ReferenceRun) {
  std::string text = quick_scene("100.0");
  const std::string shape = "kind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]";
  text.replace(text.find(shape), shape.size(), "kind = \"radial\"\nmodes = [{n = 2, m = 0, a = 0.3}]");
  write_text(scene, text);
  RunningProgram program(command);
  wait_for_rows(program);
  program.send(SIGINT);
  BOOST_TEST(program.wait().exit_code == 3);
}

BOOST_FIXTURE_TEST_CASE(two_runs_in_one_directory_are_refused, LongRun) {
  RunningProgram first(command);
  wait_for_rows(first);
  const ProgramResult second = run_command(command);
  BOOST_TEST(second.exit_code == 1);
  BOOST_TEST(second.errors ==
             output + ": another run is writing in this directory; wait for it or choose another -o\n");
  BOOST_TEST(first.wait().exit_code == 0);
  check_same_run(output, reference);
}

BOOST_FIXTURE_TEST_CASE(complete_run_has_nothing_to_do, ReferenceRun) {
  const std::string history = file_text(reference + "/history.csv");
  const ProgramResult result =
      run_vehd({"run", scene, "-o", reference, "--resume", "--json", directory / "summary.json"});
  BOOST_TEST(result.exit_code == 0);
  BOOST_TEST(result.output.find("nothing to do") != std::string::npos);
  BOOST_TEST((file_text(reference + "/history.csv") == history));
  BOOST_TEST(nlohmann::json::parse(file_text(directory / "summary.json")).at("completed").get<bool>());
}

BOOST_FIXTURE_TEST_CASE(a_later_end_continues_the_run, ReferenceRun) {
  write_text(scene, quick_scene("1.0"));
  finish();
  write_text(scene, quick_scene("3.0"));
  finish();
  check_same_run(output, reference);
}

BOOST_AUTO_TEST_SUITE_END()
