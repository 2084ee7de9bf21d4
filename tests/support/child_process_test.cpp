#include "bie/support/child_process.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <boost/test/unit_test.hpp>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <set>
#include <thread>

#include "tests/support/files.hpp"
#include "tests/support/waiting.hpp"

namespace {

constexpr std::chrono::seconds most{30};

bool is_alive(pid_t process) { return ::kill(process, 0) == 0 || errno != ESRCH; }

/// A program with children that are hard to end: in the background, in a session of their own, and ignoring SIGTERM.
/// Each writes down its process number.
struct Family {
  static constexpr std::size_t size = 5;
  TemporaryDirectory directory;

  [[nodiscard]] vehd::ChildProgram program(const std::string& last_word = "wait") const {
    const std::string member = "echo $$ >> '" + (directory / "members") + "'; ";
    const std::string deaf = "trap \"\" TERM INT HUP; ";
    write_text(directory / "sleeper.sh", member + "exec sleep 600\n");
    write_text(directory / "deaf.sh", member + deaf + "while :; do sleep 600; done\n");
    write_text(directory / "parent.sh", member + deaf + "sh " + directory / "deaf.sh" + " & wait\n");
    const std::string all = member + "sh " + (directory / "sleeper.sh") + " & setsid sh " + (directory / "sleeper.sh") +
                            " & setsid sh " + (directory / "parent.sh") + " & " + last_word;
    return {{"sh", "-c", all}, directory / "messages"};
  }

  [[nodiscard]] std::set<pid_t> members() const {
    std::istringstream text(file_text(directory / "members"));
    std::set<pid_t> result;
    for (pid_t process = 0; text >> process;) result.insert(process);
    return result;
  }

  [[nodiscard]] bool is_complete() const { return members().size() == size; }
  [[nodiscard]] bool is_gone() const {
    const std::set<pid_t> all = members();
    return std::none_of(all.begin(), all.end(), is_alive);
  }
  /// The program itself, which is the first to write its number.
  [[nodiscard]] pid_t eldest() const {
    pid_t process = 0;
    std::istringstream(file_text(directory / "members")) >> process;
    return process;
  }
};

/// A process that runs a program, in a group of its own.
class Owner {
 public:
  explicit Owner(const vehd::ChildProgram& program) : process_(::fork()) {
    if (process_ != 0) return;
    ::setpgid(0, 0);
    const vehd::ChildEnd end = vehd::run_child(program);
    ::_exit(end.signal == SIGKILL ? 9 : 0);
  }
  ~Owner() { wait(); }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;

  void send(int signal) const { ::kill(process_, signal); }
  void send_to_group(int signal) const { ::kill(-process_, signal); }
  int wait() {
    if (process_ > 0) ::waitpid(process_, &status_, 0);
    process_ = 0;
    return status_;
  }

 private:
  pid_t process_;
  int status_ = 0;
};

}  // namespace

BOOST_AUTO_TEST_SUITE(child_process)

BOOST_AUTO_TEST_CASE(end_and_output_of_a_program_are_returned) {
  const TemporaryDirectory directory;
  const vehd::ChildEnd done =
      vehd::run_child({{"sh", "-c", "echo out; echo err >&2; cat; exit 7"}, directory / "text"});
  BOOST_TEST(done.start_problem == 0);
  BOOST_TEST(done.signal == 0);
  BOOST_TEST(done.exit_code == 7);
  BOOST_TEST(file_text(directory / "text") == "out\nerr\n");
  BOOST_TEST(vehd::run_child({{"sh", "-c", "kill -9 $$"}, {}}).signal == SIGKILL);
  BOOST_TEST(vehd::run_child({{"no-such-program-of-vehd"}, {}}).start_problem == ENOENT);
  BOOST_TEST(vehd::run_child({{directory / ""}, {}}).start_problem == EACCES);
}

BOOST_AUTO_TEST_CASE(whatever_ends_the_owner_ends_all_that_it_started) {
  for (const int signal : {SIGKILL, SIGTERM, SIGINT, SIGHUP}) {
    const Family family;
    Owner owner(family.program());
    BOOST_TEST_REQUIRE(comes_true([&] { return family.is_complete(); }, most), signal);
    owner.send(signal);
    BOOST_TEST(WTERMSIG(owner.wait()) == signal);
    BOOST_TEST(comes_true([&] { return family.is_gone(); }, most), signal);
  }
}

BOOST_AUTO_TEST_CASE(a_time_limit_that_kills_the_group_of_the_owner_ends_all) {
  const Family family;
  const Owner owner(family.program());
  BOOST_TEST_REQUIRE(comes_true([&] { return family.is_complete(); }, most));
  owner.send_to_group(SIGKILL);
  BOOST_TEST(comes_true([&] { return family.is_gone(); }, most));
}

BOOST_AUTO_TEST_CASE(signals_that_the_owner_holds_back_reach_the_program) {
  sigset_t term{}, former{};
  sigemptyset(&term);
  sigaddset(&term, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &term, &former);
  const int signal = vehd::run_child({{"sh", "-c", "kill -TERM $$; exit 0"}, {}}).signal;
  pthread_sigmask(SIG_SETMASK, &former, nullptr);
  BOOST_TEST(signal == SIGTERM);
}

BOOST_AUTO_TEST_CASE(a_program_that_is_killed_takes_its_children_along) {
  const Family family;
  Owner owner(family.program());
  BOOST_TEST_REQUIRE(comes_true([&] { return family.is_complete(); }, most));
  ::kill(family.eldest(), SIGKILL);
  BOOST_TEST(WEXITSTATUS(owner.wait()) == 9);
  BOOST_TEST(family.is_gone());
}

BOOST_AUTO_TEST_CASE(children_that_a_program_leaves_behind_end_after_it) {
  const Family family;
  const std::string all_there =
      "while [ $(wc -l < '" + (family.directory / "members") + "') -lt 5 ]; do sleep 0.05; done";
  const vehd::ChildEnd end = vehd::run_child(family.program(all_there + "; exit 3"));
  BOOST_TEST(end.exit_code == 3);
  BOOST_TEST(family.is_complete());
  BOOST_TEST(family.is_gone());
}

BOOST_AUTO_TEST_SUITE_END()
