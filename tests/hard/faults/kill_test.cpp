#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "bie/files/run_reader.hpp"
#include "bie/runs/checkpoint.hpp"
#include "tests/hard/faults/faulty_run.hpp"

namespace {

/// Number of kills; `test_faults -- 200` is the long form.
int wanted_kills() {
  const auto& suite = boost::unit_test::framework::master_test_suite();
  return suite.argc > 1 ? std::stoi(suite.argv[1]) : 12;
}

/// Kills the run repeatedly, at random points of the remaining work, until it is complete; then starts it again.
class Killer {
 public:
  explicit Killer(const std::string& scene) : run_(scene), work_(run_.count_work()) {}

  void kill(int count) {
    for (int number = 0; number < count;) {
      // Two kills in three are at a file operation: a kill at a random time rarely meets a write.
      const bool hit = number % 3 == 0 ? kill_by_clock() : kill_at_operation();
      const std::int64_t accepted = run_.check_files();
      BOOST_TEST(accepted >= accepted_);
      accepted_ = accepted;
      if (hit) {
        ++number;
        continue;
      }
      check_same_run(run_.output, run_.reference);
      start_anew();
    }
    run_.finish();
    start_anew();
  }

 private:
  /// Whether the run was still running when it was killed.
  static bool was_killed(RunningProgram& program) {
    const ProgramResult result = program.wait();
    BOOST_TEST((result.exit_code == -1 || result.exit_code == 0), result.errors);
    return result.exit_code == -1;
  }

  bool kill_by_clock() {
    RunningProgram program(run_.command_with(""));
    std::uniform_real_distribution<double> part(0.0, 0.7);
    std::this_thread::sleep_for(std::chrono::duration<double>(run_.seconds * part(random_)));
    program.send(SIGKILL);
    return was_killed(program);
  }

  bool kill_at_operation() {
    std::uniform_int_distribution<std::int64_t> moment(1, work_.operations * 2 / 3);
    RunningProgram program(run_.command_with("kill " + std::to_string(moment(random_))));
    return was_killed(program);
  }

  void start_anew() {
    std::filesystem::remove_all(run_.output);
    accepted_ = 0;
  }

  FaultyRun run_;
  FaultyRun::Work work_;
  std::mt19937 random_{20240607};
  std::int64_t accepted_ = 0;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(sudden_end, *boost::unit_test::label("slow") * boost::unit_test::label("extended"))

BOOST_AUTO_TEST_CASE(fixed_steps_lose_nothing_and_reproduce_every_bit) {
  Killer(quick_scene()).kill((2 * wanted_kills() + 2) / 3);
}

BOOST_AUTO_TEST_CASE(chosen_steps_lose_nothing_and_reproduce_every_bit) {
  Killer(adaptive_scene()).kill(wanted_kills() / 3);
}

// Before its first row a run has only its scene, and so has its companion run.
BOOST_AUTO_TEST_CASE(a_start_that_dies_before_its_first_row_is_made_again) {
  std::string scene = adaptive_scene();
  scene = scene.replace(scene.find("end_time = 6.0"), 14, "end_time = 0.5\nerror_bars = true");
  const FaultyRun run(scene);
  const std::string checkpoint = run.output + "/checkpoint.h5";
  int resumed = 0;
  for (int operation = 1;; ++operation) {
    std::filesystem::remove_all(run.output);
    (void)run_command(run.command_with("kill " + std::to_string(operation)));
    (void)run.check_files();
    if (!std::filesystem::exists(checkpoint)) continue;
    if (vehd::read_checkpoint(checkpoint).n_rows > 0) break;
    run.finish();
    ++resumed;
  }
  BOOST_TEST(resumed > 0);
}

// A session with another degree rewrites all snapshots before its first step.
BOOST_AUTO_TEST_CASE(a_change_of_degree_loses_nothing_either) {
  const FaultyRun run(quick_scene("1.0"));
  const std::string begun = run.directory / "begun";
  constexpr auto kAll = std::filesystem::copy_options::recursive;
  std::filesystem::copy(run.reference, begun, kAll);
  std::string scene = quick_scene("1.5");
  scene.replace(scene.find("order = 6"), 9, "order = 8");
  write_text(run.scene, scene);
  std::filesystem::copy(begun, run.output, kAll);
  const FaultyRun::Work work = run.count_work();
  std::filesystem::remove_all(run.reference);
  std::filesystem::copy(begun, run.reference, kAll);
  std::vector<std::string> undisturbed = run.command;
  *std::ranges::find(undisturbed, run.output) = run.reference;
  BOOST_TEST_REQUIRE(run_command(undisturbed).exit_code == 0);
  std::mt19937 random{20240608};
  std::uniform_int_distribution<std::int64_t> moment(1, work.operations);
  for (int number = 0; number < wanted_kills(); ++number) {
    std::filesystem::remove_all(run.output);
    std::filesystem::copy(begun, run.output, kAll);
    (void)run_command(run.command_with("kill " + std::to_string(moment(random))));
    // The accepted snapshots are present, whatever their degree.
    const vehd::RunReader accepted(run.output + "/run.h5");
    BOOST_TEST_REQUIRE(accepted.times().size() >= 3U);
    for (std::size_t snapshot = 0; snapshot < accepted.times().size(); ++snapshot) {
      (void)accepted.snapshot(snapshot);
    }
    run.finish();
  }
}

BOOST_AUTO_TEST_SUITE_END()
