#include "bie/support/worker_pool.hpp"

#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "bie/support/exit_code.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

WorkerPool::~WorkerPool() {
  stop();
  for (const Copy& copy : copies_) {
    while (::waitpid(copy.process, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
}

void WorkerPool::start(int number) {
  // Otherwise a copy would write buffered output a second time.
  std::fflush(nullptr);
  const pid_t owner = ::getpid();
  const pid_t process = ::fork();
  if (process < 0) throw OutputError(fmt::format("no other process can be started: {}", std::strerror(errno)));
  if (process > 0) {
    copies_.push_back({process, number});
    return;
  }
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  int exit_code = static_cast<int>(ExitCode::internal_error);
  try {
    if (::getppid() == owner) exit_code = work_(number);
  } catch (...) {
  }
  // Exit handlers of the owner must not run in a copy.
  std::fflush(nullptr);
  ::_exit(exit_code);
}

std::optional<WorkerPool::End> WorkerPool::next_end() {
  for (auto copy = copies_.begin(); copy != copies_.end(); ++copy) {
    int status = 0;
    if (::waitpid(copy->process, &status, WNOHANG) != copy->process) continue;
    const int number = copy->number;
    copies_.erase(copy);
    if (WIFEXITED(status)) return End{number, WEXITSTATUS(status), 0};
    return End{number, 0, WTERMSIG(status)};
  }
  return std::nullopt;
}

void WorkerPool::stop() const {
  for (const Copy& copy : copies_) ::kill(copy.process, SIGTERM);
}

}  // namespace vehd
