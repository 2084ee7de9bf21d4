#include <fmt/format.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <csignal>
#include <cstring>

#include "tests/app/sweep_folder.hpp"
#include "tests/hard/faults/faulty_run.hpp"

BOOST_AUTO_TEST_SUITE(concurrency)

BOOST_AUTO_TEST_CASE(of_two_runs_started_together_one_is_refused) {
  const FaultyRun run;
  for (int trial = 0; trial < 6; ++trial) {
    RunningProgram first(run.command), second(run.command);
    const ProgramResult a = first.wait(), b = second.wait();
    // The second run may also find the first one complete and have nothing to do.
    const auto refused = [&](const ProgramResult& result) {
      return result.exit_code == 1 &&
             result.errors ==
                 run.output + ": another run is writing in this directory; wait for it or choose another -o\n";
    };
    BOOST_TEST((a.exit_code == 0 || b.exit_code == 0), a.errors << b.errors);
    BOOST_TEST((a.exit_code == 0 || refused(a)), a.errors);
    BOOST_TEST((b.exit_code == 0 || refused(b)), b.errors);
    check_same_run(run.output, run.reference);
    std::filesystem::remove_all(run.output);
  }
}

BOOST_AUTO_TEST_CASE(a_killed_run_lets_the_next_one_in_at_once) {
  const EndlessRun run;
  {
    RunningProgram program(run.command);
    run.wait_for_rows(program);
    program.send(SIGKILL);
    BOOST_TEST(program.wait().exit_code == -1);
  }
  run.finish_soon();
}

BOOST_AUTO_TEST_CASE(a_file_system_without_locks_is_no_second_run) {
  const SweepWork work;
  work.write_sweep("\"electric.conductivity_in\" = {values = [0.5, 1.0]}\n");
  for (const int problem : {ENOSYS, ENOLCK}) {
    const std::string fault = fmt::format("unlocked {}", problem);
    const std::string text = fmt::format(": cannot be locked against a second run: {}; ", std::strerror(problem));
    const ProgramResult run = run_command(
        with_fault(fault, vehd_command({"run", work.directory / "base.toml", "-o", work.directory / "run"})));
    BOOST_TEST(run.exit_code == 1);
    BOOST_TEST(run.errors.starts_with(work.directory / "run" + text), run.errors);
    // Workers of a sweep rely only on their claims. HDF5 ignores the failure of its own file locks only if locking is
    // not supported.
    std::vector<std::string> command = with_fault(fault, work.command({"--jobs", "2"}));
    if (problem == ENOLCK) {
      const ProgramResult locked = run_command(command);
      BOOST_TEST(locked.exit_code == 3);
      BOOST_TEST(locked.errors.find(std::strerror(problem)) != std::string::npos, locked.errors);
      command.insert(command.begin(), {"env", "HDF5_USE_FILE_LOCKING=FALSE"});
    }
    const ProgramResult sweep = run_command(command);
    BOOST_TEST(sweep.exit_code == 0, sweep.errors);
    BOOST_TEST(sweep.output.find("2 runs: 2 completed") == 0, sweep.output);
    std::filesystem::remove_all(work.output);
  }
}

BOOST_AUTO_TEST_SUITE_END()
