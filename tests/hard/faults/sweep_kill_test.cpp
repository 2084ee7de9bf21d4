#include <boost/test/unit_test.hpp>
#include <csignal>
#include <random>
#include <thread>

#include "tests/app/sweep_folder.hpp"

namespace {

/// Number of killed workers; `test_faults -- 200` is the long form.
int wanted_worker_kills() {
  const auto& suite = boost::unit_test::framework::master_test_suite();
  return suite.argc > 1 ? std::stoi(suite.argv[1]) : 8;
}

}  // namespace

BOOST_AUTO_TEST_SUITE(killed_workers)

// Kills workers at random times, and one time in ten the process that started them.
BOOST_AUTO_TEST_CASE(of_a_sweep_lose_no_row_and_double_none) {
  const int n_kills = wanted_worker_kills();
  const SweepWork work(quick_scene("6"));
  work.write_sweep("\"electric.conductivity_in\" = {from = 0.5, to = 2.0, count = " +
                   std::to_string(n_kills < 50 ? 12 : 100) + "}\n");
  const std::string undisturbed = work.directory / "undisturbed";
  BOOST_TEST_REQUIRE(work.run({"--jobs", "2"}, undisturbed).exit_code == 0);
  std::mt19937 random{20240609};
  std::uniform_int_distribution<int> milliseconds(5, 120), one_in_ten(0, 9);
  int killed = 0;
  while (killed < n_kills) {
    RunningProgram program(work.command({"--jobs", "2"}));
    int killed_of_these = 0;
    while (killed < n_kills && !program.ended()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds(random)));
      const std::vector<pid_t> workers = work.workers();
      if (workers.empty() || program.ended()) continue;
      ++killed;
      // A run whose workers are killed 21 times is given up; if the machine is slow or busy, none of them gets far
      // enough to finish it.
      if (one_in_ten(random) == 0 || ++killed_of_these == 20) {
        program.send(SIGKILL);
        program.wait();
        break;
      }
      ::kill(workers[random() % workers.size()], SIGKILL);
    }
    // The sweep was complete before there were enough kills: start again.
    if (program.ended() && program.wait().exit_code == 0) std::filesystem::remove_all(work.output);
  }
  const ProgramResult result = work.run({"--jobs", "2"});
  BOOST_TEST(result.exit_code == 0, result.errors);
  BOOST_TEST((work.table() == work.table(undisturbed)));
  // A run computed by two workers at once would have rows of both.
  for (const auto& row : work.table()) {
    if (row.back() == "run") continue;
    BOOST_TEST(file_text(work.output + "/runs/" + row.back() + "/history.csv") ==
               file_text(undisturbed + "/runs/" + row.back() + "/history.csv"));
  }
}

// Prints the overhead of a sweep beyond its runs; no duration is asserted.
BOOST_AUTO_TEST_CASE(of_many_short_runs_each_has_its_row) {
  const int n_runs = wanted_worker_kills() < 50 ? 20 : 1000;
  const SweepWork work(quick_scene("3"));
  work.write_sweep("\"electric.conductivity_in\" = {from = 0.5, to = 2.0, count = " + std::to_string(n_runs) + "}\n");
  const auto start = std::chrono::steady_clock::now();
  const ProgramResult result = work.run({"--jobs", "1", "--json", work.directory / "result.json"});
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
  BOOST_TEST(result.exit_code == 0, result.errors);
  const nlohmann::json json = json_of(work.directory / "result.json");
  BOOST_TEST(json["completed"] == n_runs);
  const double computed = json["seconds"];
  BOOST_TEST_MESSAGE(n_runs << " runs: " << seconds.count() << " s, of which runs " << computed << " s");
}

BOOST_AUTO_TEST_SUITE_END()
