#include <signal.h>

#include <algorithm>
#include <boost/test/unit_test.hpp>
#include <chrono>
#include <functional>
#include <thread>

#include "tests/app/finite_elements.hpp"
#include "tests/app/program.hpp"
#include "tests/support/waiting.hpp"

namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds most{120};

/// A check that takes far longer than the test; its processes are identified by its folder.
struct LongCheck {
  TemporaryDirectory directory;
  std::vector<std::string> command;

  explicit LongCheck(const std::string& n_ranks = "2") {
    write_text(directory / "scene.toml",
               "[shape]\nkind = 'ellipsoid'\naxes = [1.0, 1.2, 1.5]\n[membrane]\nconductance = 5.0\n"
               "[electric]\nfield = [0.0, 0.0, 1.0]\nconductivity_in = 1.0\nconductivity_out = 2.0\n"
               "[numerics]\norder = 8\ndt = 0.1\nend_time = 0.0\n");
    // Killed processes leave temporary files behind; these are removed with the folder.
    command = {"env", "TMPDIR=" + directory / ""};
    for (const std::string& word :
         vehd_command({"check", directory / "scene.toml", "-o", directory / "out", "--ranks", n_ranks, "--no-plot"})) {
      command.push_back(word);
    }
  }

  /// Processes of this check that run the program.
  [[nodiscard]] std::vector<pid_t> processes(const std::string& program) const {
    std::vector<pid_t> found;
    for (const auto& entry : fs::directory_iterator("/proc")) {
      const pid_t process = std::atoi(entry.path().filename().c_str());
      if (process == 0) continue;
      const std::string words = file_text(entry.path() / "cmdline");
      std::string name = fs::path(words.substr(0, words.find('\0'))).filename();
      // The mpirun of Open MPI 5 has this process name.
      if (name == "prterun") name = "mpirun";
      if (name == program && words.find(directory / "out") != std::string::npos) found.push_back(process);
    }
    return found;
  }

  [[nodiscard]] bool is_at_work() const { return processes("vehd_fem").size() == 2; }
  [[nodiscard]] bool is_gone() const { return processes("vehd_fem").empty() && processes("mpirun").empty(); }
};

}  // namespace

BOOST_AUTO_TEST_SUITE(check_end, *boost::unit_test::precondition(finite_elements_are_built) *
                                     boost::unit_test::label("alone") * boost::unit_test::label("once"))

BOOST_AUTO_TEST_CASE(whatever_ends_a_check_ends_its_finite_elements) {
  for (const int signal : {SIGKILL, SIGTERM, SIGINT}) {
    const LongCheck check;
    RunningProgram program(check.command);
    BOOST_TEST_REQUIRE(comes_true([&] { return check.is_at_work(); }, most), signal);
    program.send(signal);
    program.wait();
    BOOST_TEST(comes_true([&] { return check.is_gone(); }, most), signal);
  }
}

BOOST_AUTO_TEST_CASE(time_limit_that_kills_all_it_can_reach_ends_the_finite_elements) {
  const LongCheck check;
  std::vector<std::string> command{"timeout", "-s", "KILL", "3600"};
  command.insert(command.end(), check.command.begin(), check.command.end());
  RunningProgram program(command);
  BOOST_TEST_REQUIRE(comes_true([&] { return check.is_at_work(); }, most));
  // Kills the process group of the check, which the program timeout leads, as timeout does when the time is over.
  const std::vector<pid_t> leader = check.processes("timeout");
  BOOST_TEST_REQUIRE(leader.size() == 1);
  ::kill(-leader.front(), SIGKILL);
  program.wait();
  BOOST_TEST(comes_true([&] { return check.is_gone(); }, most));
}

BOOST_AUTO_TEST_CASE(finite_elements_that_are_killed_end_the_check) {
  for (const char* victim : {"mpirun", "vehd_fem"}) {
    const LongCheck check;
    RunningProgram program(check.command);
    BOOST_TEST_REQUIRE(comes_true([&] { return check.is_at_work(); }, most), victim);
    const std::vector<pid_t> victims = check.processes(victim);
    BOOST_TEST_REQUIRE(!victims.empty(), victim);
    for (const pid_t process : victims) ::kill(process, SIGKILL);
    BOOST_TEST_REQUIRE(comes_true([&] { return program.ended(); }, most), victim);
    BOOST_TEST(program.wait().exit_code > 0, victim);
    BOOST_TEST(check.is_gone(), victim);
  }
}

// Regression: a check that ended removed the folder that another one, just starting, had made for Open MPI 4.
BOOST_AUTO_TEST_CASE(checks_at_the_same_time_share_no_folder) {
  if (run_command({"mpirun", "--version"}).output.find("(Open MPI) 4.") == std::string::npos) {
    BOOST_TEST_MESSAGE("other versions remove no shared folder");
    return;
  }
  for (const std::string n_ranks : {"1", "2"}) {
    LongCheck check(n_ranks);
    check.command.push_back("--quick");
    RunningProgram program(check.command);
    const auto has_folder = [&] {
      return std::ranges::any_of(fs::directory_iterator(check.directory / ""), [](const fs::directory_entry& entry) {
        return entry.path().filename().string().starts_with("ompi.");
      });
    };
    bool shared = false;
    BOOST_TEST_REQUIRE(comes_true([&] { return (shared = shared || has_folder()) || program.ended(); }, most), n_ranks);
    BOOST_TEST(!shared, n_ranks);
    program.send(SIGTERM);
    program.wait();
  }
}

BOOST_AUTO_TEST_SUITE_END()
