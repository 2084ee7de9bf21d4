#include "bie/runs/sweep/heartbeat.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

namespace vehd {

Heartbeat::Heartbeat(std::chrono::milliseconds beat) : interval_(beat), thread_([this] { this->beat(); }) {}

Heartbeat::~Heartbeat() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Heartbeat::watch(const std::filesystem::path& claim) {
  const std::lock_guard lock(mutex_);
  claim_ = claim;
  lost_ = false;
}

bool Heartbeat::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

void Heartbeat::beat() {
  std::unique_lock lock(mutex_);
  while (!changed_.wait_for(lock, interval_, [this] { return ends_; })) {
    if (claim_.empty() || lost_) continue;
    if (::utimensat(AT_FDCWD, claim_.c_str(), nullptr, 0) == 0 || errno != ENOENT) continue;
    lost_ = true;
    ::kill(::getpid(), SIGTERM);
  }
}

}  // namespace vehd
