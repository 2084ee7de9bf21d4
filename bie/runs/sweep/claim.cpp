#include "bie/runs/sweep/claim.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <condition_variable>
#include <csignal>
#include <mutex>

#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

namespace fs = std::filesystem;

/// Network file systems show the time of a file up to a minute late; the rest allows for a dozen missed renewals.
constexpr std::chrono::seconds patience{300};

/// Identifies this machine since it was last started.
const std::string& this_machine() {
  static const std::string id = text_of_file("/proc/sys/kernel/random/boot_id");
  return id;
}

fs::path claim_file(const fs::path& directory, int number) { return directory / fmt::format("claim.{}", number); }

}  // namespace

std::unique_ptr<Claim> Claim::take(const fs::path& directory, std::chrono::milliseconds renewal) {
  make_directory(directory);
  std::unique_ptr<DirectoryLock> lock;
  try {
    lock = std::make_unique<DirectoryLock>(RunPaths{directory}.lock());
  } catch (const DirectoryBusy&) {
    return nullptr;
  } catch (const NoLocks&) {
  }
  int last = 0;
  while (fs::exists(claim_file(directory, last + 1))) ++last;
  const TemporaryFile made(unique_name_beside(directory / "claim"));
  replace_file(made.path(), this_machine());
  if (last > 0) {
    const fs::path former = claim_file(directory, last);
    const bool is_from_here = lock && text_of_file(former) == this_machine();
    const auto age = fs::last_write_time(made.path()) - fs::last_write_time(former);
    if (!is_from_here && age <= patience) return nullptr;
  }
  std::error_code problem;
  fs::create_hard_link(made.path(), claim_file(directory, last + 1), problem);
  // A network file system may report a failure although an earlier attempt of its own succeeded.
  if (fs::hard_link_count(made.path()) > 1) {
    return std::unique_ptr<Claim>(new Claim(std::move(lock), directory, last + 1, renewal));
  }
  if (problem == std::errc::file_exists) return nullptr;
  throw OutputError(fmt::format("{}: cannot be claimed: {}", directory.string(), problem.message()));
}

Claim::Claim(std::unique_ptr<DirectoryLock> lock, const fs::path& directory, int number,
             std::chrono::milliseconds renewal)
    : lock_(std::move(lock)),
      file_(claim_file(directory, number)),
      next_(claim_file(directory, number + 1)),
      renewal_([this, renewal](const std::stop_token& stop) { renew(stop, renewal); }) {}

Claim::~Claim() {
  renewal_.request_stop();
  renewal_.join();
  std::error_code ignored;
  fs::last_write_time(file_, std::chrono::file_clock::from_sys(std::chrono::sys_seconds{}), ignored);
}

bool Claim::is_lost() const {
  std::error_code ignored;
  return fs::exists(next_, ignored);
}

void Claim::renew(const std::stop_token& stop, std::chrono::milliseconds interval) const {
  std::mutex mutex;
  std::condition_variable_any stopped;
  for (std::unique_lock guard(mutex); !is_lost(); ::utimensat(AT_FDCWD, file_.c_str(), nullptr, 0)) {
    stopped.wait_for(guard, stop, interval, [] { return false; });
    if (stop.stop_requested()) return;
  }
  ::kill(::getpid(), SIGTERM);
}

}  // namespace vehd
