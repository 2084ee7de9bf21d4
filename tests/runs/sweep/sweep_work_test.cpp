#include "bie/runs/sweep/sweep_work.hpp"

#include <boost/test/unit_test.hpp>
#include <fstream>

#include "bie/runs/session.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

// Counts the work of a sweep besides its runs: per run it must stay the same, however many runs there are.
BOOST_AUTO_TEST_SUITE(sweep_work)

namespace {

/// Number of read and write calls of this process.
long reads_and_writes() {
  std::ifstream file("/proc/self/io");
  std::string name;
  long total = 0, value = 0;
  while (file >> name >> value) total += name == "syscr:" || name == "syscw:" ? value : 0;
  return total;
}

template <typename Work>
long counted(const Work& work) {
  const long before = reads_and_writes();
  work();
  const long after = reads_and_writes();
  // Reading the count is counted as well.
  return after - before - (reads_and_writes() - after);
}

/// A sweep of n quick runs.
struct CountedSweep {
  TemporaryDirectory directory;
  vehd::SweepFile sweep;
  std::vector<vehd::SweepRun> runs;
  vehd::SweepPaths paths{directory / "out"};

  explicit CountedSweep(int n) {
    write_text(directory / "base.toml", quick_scene("0.5"));
    write_text(directory / "sweep.toml",
               "scene = \"base.toml\"\n[vary]\n\"electric.conductivity_in\" = {from = 1.0, to = 2.0, count = " +
                   std::to_string(n) + "}\n");
    sweep = vehd::read_sweep(directory / "sweep.toml");
    runs = vehd::runs_of(sweep);
    std::filesystem::create_directories(paths.runs());
  }

  void leave_results() const {
    for (const vehd::SweepRun& run : runs) {
      std::filesystem::create_directories(paths.runs() / run.name);
      vehd::write_result(paths.runs() / run.name, {"trustworthy", "", 1.0, {{"time", "0.5"}}});
    }
  }
  void work(std::size_t first = 0) const {
    vehd::Interruption interruption;
    vehd::WorkerBoard board{};
    const vehd::SweepTask task{.paths = paths, .runs = runs, .first = first};
    BOOST_TEST((vehd::work_at_sweep(task, interruption, board) == vehd::WorkerEnd::nothing_left));
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(a_table_reads_each_result_twice_however_many_there_are) {
  const auto accesses = [](int n) {
    const CountedSweep sweep(n);
    sweep.leave_results();
    return counted([&] { BOOST_TEST(write_sweep_table(sweep.paths, sweep.sweep, sweep.runs).completed == n); });
  };
  const long few = accesses(20), some = accesses(40), many = accesses(80);
  // Each file takes one read and another that finds its end.
  BOOST_TEST(some - few <= 20 * 4 + 4);
  BOOST_TEST(many - some <= 40 * 4 + 4);
  BOOST_TEST(many > 80);
}

BOOST_AUTO_TEST_CASE(finished_runs_are_not_read_again) {
  const CountedSweep few(2), many(50);
  few.leave_results();
  many.leave_results();
  BOOST_TEST(counted([&] { many.work(); }) == counted([&] { few.work(); }));
}

BOOST_AUTO_TEST_CASE(a_worker_writes_one_result_beyond_the_files_of_a_run) {
  const auto added_by_worker = [](int n) {
    const CountedSweep sweep(n);
    const long alone = counted([&] {
      vehd::Interruption interruption;
      for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
        const vehd::RunSession session(*sweep.runs[i].scene, {sweep.sweep.scene_file, {}},
                                       sweep.directory / ("alone" + std::to_string(i)), true);
        static_cast<void>(
            session.summarise(vehd::simulate(session.task({}, vehd::longest_lag_of_files), interruption)));
      }
    });
    BOOST_TEST(alone > 20 * n);
    return counted([&] { sweep.work(); }) - alone;
  };
  // For each run the history is read for its last row, and result.json is written.
  BOOST_TEST(added_by_worker(5) - added_by_worker(2) <= 3 * 4);
}

BOOST_AUTO_TEST_CASE(a_worker_begins_with_its_run_and_comes_round_to_those_before_it) {
  const CountedSweep sweep(3);
  sweep.work(1);
  const auto end_of = [&](std::size_t i) {
    return std::filesystem::last_write_time(sweep.paths.run(sweep.runs[i]) / "result.json");
  };
  BOOST_TEST((end_of(1) < end_of(2)));
  BOOST_TEST((end_of(2) < end_of(0)));
}

BOOST_AUTO_TEST_CASE(seconds_of_a_run_are_those_of_all_its_work) {
  const CountedSweep sweep(2);
  sweep.work();
  const std::filesystem::path directory = sweep.paths.runs() / sweep.runs[0].name;
  const auto summary = nlohmann::json::parse(std::ifstream(directory / "summary.json"));
  const auto result = vehd::read_result(directory);
  BOOST_TEST_REQUIRE(result.has_value());
  // The time of a result includes set-up and files besides the steps.
  BOOST_TEST(result->seconds > summary["seconds"].get<double>());
}

BOOST_AUTO_TEST_SUITE_END()
