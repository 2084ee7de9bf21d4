#include "bie/support/child_process.hpp"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace vehd {
namespace {

namespace fs = std::filesystem;

/// The executable may be Python, so this library gives the path.
fs::path folder_of_this_library() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&folder_of_this_library), &info) == 0) return {};
  std::error_code error;
  return fs::canonical(info.dli_fname, error).parent_path();
}

}  // namespace

fs::path program_path(const std::string& name) { return program_path(name, folder_of_this_library()); }

fs::path program_path(const std::string& name, const fs::path& libraries) {
  const fs::path programs = libraries / "programs";
  std::error_code error;
  if (libraries.empty() || !fs::is_directory(programs, error)) return name;
  const fs::path root = libraries.parent_path().parent_path();
  // Fonts that the user has configured take precedence.
  ::setenv("FONTCONFIG_FILE", (root / "share/vehd/fonts.conf").c_str(), 0);
  if (fs::is_directory(root / "share/openmpi", error)) {
    // The libraries of the archive must not load plugins of another Open MPI that a cluster sets.
    ::setenv("OPAL_PREFIX", root.c_str(), 1);
    ::setenv("PMIX_PREFIX", (root / "lib/x86_64-linux-gnu/pmix2").c_str(), 1);
  }
  return fs::exists(programs / name, error) ? programs / name : fs::path(name);
}

namespace {

constexpr long grace_milliseconds = 800;
constexpr long look_milliseconds = 5;
/// The first after the three standard ones.
constexpr int connection_to_owner = STDERR_FILENO + 1;

/// Prepared before the fork: the child of a process with several threads must not allocate memory.
struct Start {
  const char* file;  ///< a path, or a name to look for in PATH
  char* const* words;
  const char* output;  ///< null: that of this process
  const char* folder;  ///< null: that of this process
};

long milliseconds_now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * 1000 + now.tv_nsec / 1'000'000;
}

void report(const ChildEnd& end) { ::send(connection_to_owner, &end, sizeof end, MSG_NOSIGNAL); }

ChildEnd end_of(int status) {
  return WIFEXITED(status) ? ChildEnd{.exit_code = WEXITSTATUS(status)} : ChildEnd{.signal = WTERMSIG(status)};
}

/// Becomes the program, in the last of the three processes.
[[noreturn]] void become(const Start& start, pid_t guardian) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != guardian) ::_exit(1);
  sigset_t none{};
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  ::dup2(::open("/dev/null", O_RDONLY | O_CLOEXEC), STDIN_FILENO);
  if (start.output != nullptr) {
    const int output = ::open(start.output, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (output < 0) {
      report({.start_problem = errno});
      ::_exit(1);
    }
    ::dup2(output, STDOUT_FILENO);
    ::dup2(output, STDERR_FILENO);
  }
  if (start.folder == nullptr || ::chdir(start.folder) == 0) ::execvp(start.file, start.words);
  report({.start_problem = errno});
  ::_exit(1);
}

/// Sends SIGKILL to every child of this process.
void kill_children() {
  const int list = ::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC);
  // Without such a list the guardian can only reach its own process group, itself included.
  if (list < 0) ::kill(0, SIGKILL);
  std::array<char, 4096> text{};
  pid_t process = 0;
  for (ssize_t size = 0; (size = ::read(list, text.data(), text.size())) > 0;) {
    for (ssize_t i = 0; i < size; ++i) {
      const char letter = text[static_cast<std::size_t>(i)];
      if (letter >= '0' && letter <= '9') {
        process = 10 * process + (letter - '0');
      } else if (process > 0) {
        ::kill(process, SIGKILL);
        process = 0;
      }
    }
  }
  ::close(list);
}

/// Waits for all children, adopted ones included; kills those that are left after the grace period.
/// @return outcome of the program
ChildEnd end_everything(pid_t program) {
  ChildEnd end;
  const long deadline = milliseconds_now() + grace_milliseconds;
  for (;;) {
    int status = 0;
    const pid_t ended = ::waitpid(-1, &status, WNOHANG);
    if (ended < 0 && errno == ECHILD) return end;
    if (ended == program) end = end_of(status);
    if (ended > 0) continue;
    // This process adopts the children of killed ones, so several rounds may be needed.
    if (milliseconds_now() >= deadline) kill_children();
    const timespec pause{0, look_milliseconds * 1'000'000};
    ::nanosleep(&pause, nullptr);
  }
}

/// The guardian process: starts the program and ensures that all its processes end.
[[noreturn]] void guard(const Start& start, int connection) {
  ::setsid();
  prctl(PR_SET_NAME, "vehd-guard");
  prctl(PR_SET_CHILD_SUBREAPER, 1);
  std::signal(SIGCHLD, SIG_DFL);
  // Locks and pipes of the owner must not stay open here.
  if (connection != connection_to_owner) ::dup3(connection, connection_to_owner, O_CLOEXEC);
  ::close_range(connection_to_owner + 1, ~0U, 0);

  const pid_t guardian = ::getpid();
  const pid_t program = ::fork();
  if (program == 0) become(start, guardian);
  const int program_end = program < 0 ? -1 : static_cast<int>(::syscall(SYS_pidfd_open, program, 0));
  if (program_end < 0) {
    report({.start_problem = errno});
    if (program > 0) ::kill(program, SIGKILL);
    ::_exit(1);
  }
  // The owner sends nothing: any event on its side is its end.
  std::array<pollfd, 2> awaited{{{connection_to_owner, POLLIN, 0}, {program_end, POLLIN, 0}}};
  while (::poll(awaited.data(), awaited.size(), -1) < 0 && errno == EINTR) {
  }
  if (awaited[1].revents == 0) ::kill(program, SIGTERM);
  report(end_everything(program));
  ::_exit(0);
}

}  // namespace

ChildEnd run_child(const ChildProgram& program) {
  std::vector<std::string> words = program.words;
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const auto path_or_null = [](const std::filesystem::path& path) { return path.empty() ? nullptr : path.c_str(); };
  // Open MPI takes a path in its first word as a request to run its daemons from there, so the words stay as they are.
  const std::filesystem::path file = program_path(program.words[0]);
  const Start start{file.c_str(), pointers.data(), path_or_null(program.output), path_or_null(program.folder)};
  std::array<int, 2> connection{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, connection.data()) != 0) return {.start_problem = errno};
  // Earlier output of this program comes first.
  std::fflush(stdout);
  const pid_t guardian = ::fork();
  if (guardian == 0) guard(start, connection[1]);
  const int fork_problem = errno;
  ::close(connection[1]);
  // Holds if the guardian was killed, which then reports nothing.
  ChildEnd end{.signal = SIGKILL};
  if (guardian < 0) {
    end = {.start_problem = fork_problem};
  } else {
    while (::read(connection[0], &end, sizeof end) < 0 && errno == EINTR) {
    }
    while (::waitpid(guardian, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::close(connection[0]);
  return end;
}

}  // namespace vehd
