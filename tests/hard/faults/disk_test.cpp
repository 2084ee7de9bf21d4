#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <random>
#include <utility>

#include "tests/hard/faults/faulty_run.hpp"

namespace {

constexpr const char* scene_end = "3.0";

/// Requires that the run states the reason, loses nothing, and continues to the same result without the fault.
void check_stop(const FaultyRun& run, const std::vector<std::string>& command, const std::string& reason) {
  const ProgramResult result = run_command(command);
  // Before its first files are written there is nothing to continue.
  const bool begun = std::filesystem::exists(run.output + "/history.csv");
  BOOST_TEST((result.exit_code == 3 || (result.exit_code == 1 && !result.output.starts_with("completed"))),
             result.exit_code << result.errors);
  BOOST_TEST(result.errors.find(reason) != std::string::npos, result.errors);
  BOOST_TEST((begun || result.exit_code == 1), result.errors);
  BOOST_TEST(std::count(result.errors.begin(), result.errors.end(), '\n') <= 2, result.errors);
  (void)run.check_files();
  run.finish();
  std::filesystem::remove_all(run.output);
}

/// Stops the run a dozen times, at random points of its work.
void check_stops(const FaultyRun& run, const std::string& fault, std::pair<std::int64_t, std::int64_t> places,
                 const std::string& reason) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::int64_t> place(places.first, places.second);
  for (int trial = 0; trial < 12; ++trial) {
    check_stop(run, run.command_with(fault + std::to_string(place(random))), reason);
  }
}

}  // namespace

BOOST_AUTO_TEST_SUITE(disk)

BOOST_AUTO_TEST_CASE(full_at_any_byte_stops_the_run_and_loses_nothing) {
  const FaultyRun run(quick_scene(scene_end));
  check_stops(run, "full ", {0, run.count_work().bytes * 4 / 5}, "No space left on device");
}

BOOST_AUTO_TEST_CASE(file_system_that_turns_read_only_stops_the_run_and_loses_nothing) {
  const FaultyRun run(quick_scene(scene_end));
  check_stops(run, "readonly ", {1, run.count_work().operations * 4 / 5}, "Read-only file system");
}

// The kernel's own limit, without the shim. The smallest is two blocks, because some OpenMP libraries need a kilobyte
// of shared memory before the program begins.
BOOST_AUTO_TEST_CASE(limit_of_the_file_size_stops_the_run_and_loses_nothing) {
  const FaultyRun run(quick_scene(scene_end));
  for (const int blocks : {2, 64, 512, 1024}) {
    std::vector<std::string> command = {"sh", "-c", "ulimit -f " + std::to_string(blocks) + "; exec \"$0\" \"$@\""};
    command.insert(command.end(), run.command.begin(), run.command.end());
    check_stop(run, command, "File too large");
  }
}

BOOST_AUTO_TEST_CASE(directory_without_permission_is_left_as_it_is) {
  const FaultyRun run(quick_scene(scene_end));
  std::vector<std::string> unprivileged;
  if (geteuid() == 0) unprivileged = {"setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"};
  std::vector<std::string> probe = unprivileged;
  probe.insert(probe.end(), {VEHD_PROGRAM, "--version"});
  if (run_command(probe).exit_code != 0) {
    BOOST_TEST_MESSAGE("skipped: the user nobody cannot run " VEHD_PROGRAM);
    return;
  }
  const auto command = [&](const std::string& output, bool resume) {
    std::vector<std::string> result = unprivileged;
    result.insert(result.end(), {VEHD_PROGRAM, "run", run.scene, "-o", output, "--no-plot"});
    if (resume) result.emplace_back("--resume");
    return result;
  };
  using std::filesystem::perms;
  std::filesystem::permissions(run.directory / "", perms::owner_all | perms::others_read | perms::others_exec |
                                                       perms::group_read | perms::group_exec);
  for (const bool resume : {false, true}) {
    const std::string output = resume ? run.reference : run.directory / "closed";
    std::filesystem::create_directory(output);
    std::filesystem::permissions(output,
                                 perms::owner_read | perms::owner_exec | perms::others_read | perms::others_exec);
    const std::string history = resume ? file_text(output + "/history.csv") : "";
    const ProgramResult result = run_command(command(output, resume));
    BOOST_TEST(result.exit_code == 1);
    BOOST_TEST(result.errors == output + ": cannot be written: Permission denied\n");
    if (resume) BOOST_TEST((file_text(output + "/history.csv") == history));
    std::filesystem::permissions(output, perms::owner_all);
  }
}

BOOST_AUTO_TEST_CASE(directory_that_vanishes_ends_the_run_in_order) {
  const EndlessRun run;
  RunningProgram program(run.command);
  run.wait_for_rows(program);
  std::filesystem::rename(run.output, run.directory / "moved");
  const ProgramResult result = program.wait();
  BOOST_TEST(result.exit_code == 3);
  BOOST_TEST(result.errors.find("cannot be ") != std::string::npos, result.errors);
  std::filesystem::rename(run.directory / "moved", run.output);
  run.finish_soon();
}

BOOST_AUTO_TEST_SUITE_END()
