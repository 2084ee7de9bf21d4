#include <boost/test/unit_test.hpp>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include "tests/hard/faults/faulty_run.hpp"

namespace {

/// `test_faults -- 200` is the long form.
int wanted_kills() {
  const auto& suite = boost::unit_test::framework::master_test_suite();
  return suite.argc > 1 ? std::stoi(suite.argv[1]) : 12;
}

/// Kills the run again and again, each time somewhere in what is left of it, until it is complete; then anew.
class Killer {
 public:
  explicit Killer(const std::string& scene) : run_(scene), work_(run_.count_work()) {}

  void kill(int count) {
    for (int number = 0; number < count;) {
      // Two in three at a file operation: by the clock a write is rarely met.
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
  /// Whether the run was still there to be killed.
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

BOOST_AUTO_TEST_SUITE(sudden_end)

BOOST_AUTO_TEST_CASE(fixed_steps_lose_nothing_and_reproduce_every_bit) {
  Killer(quick_scene()).kill((2 * wanted_kills() + 2) / 3);
}

BOOST_AUTO_TEST_CASE(chosen_steps_lose_nothing_and_reproduce_every_bit) {
  Killer(adaptive_scene()).kill(wanted_kills() / 3);
}

BOOST_AUTO_TEST_SUITE_END()
