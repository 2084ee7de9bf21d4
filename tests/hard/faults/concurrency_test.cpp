#include <boost/test/unit_test.hpp>
#include <csignal>

#include "tests/hard/faults/faulty_run.hpp"

BOOST_AUTO_TEST_SUITE(concurrency)

BOOST_AUTO_TEST_CASE(of_two_runs_started_together_one_is_refused) {
  const FaultyRun run;
  for (int trial = 0; trial < 6; ++trial) {
    RunningProgram first(run.command), second(run.command);
    const ProgramResult a = first.wait(), b = second.wait();
    // The second may as well find the first complete and have nothing to do.
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

BOOST_AUTO_TEST_SUITE_END()
