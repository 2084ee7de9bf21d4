#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "bie/runs/run_directory.hpp"

namespace vehd {

/// The right to compute a run of a sweep, until destruction.
///
/// On one machine it is the lock of the run directory, which is released when the process ends. On a file system that
/// machines share, a lock may act within one machine only, and some file systems have no locks. The holder of the lock
/// therefore adds a file to the directory: claim.1, the next one claim.2, and so on. If several workers create the same
/// file, one succeeds. The last file counts. It names the machine, and its worker renews its time. It is void if it is
/// from this machine, where the lock was free, or older than 300 s by the clock of the file system.
class Claim {
 public:
  /// @param directory  of the run; created if it is missing
  /// @param renewal    time between renewals
  /// @return           null if another worker has the run
  /// @throws OutputError, std::filesystem::filesystem_error if the directory cannot be used
  static std::unique_ptr<Claim> take(const std::filesystem::path& directory,
                                     std::chrono::milliseconds renewal = std::chrono::seconds(20));
  /// Releases the run: other workers need not wait.
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Whether another worker has a later claim, because this process was suspended. The process receives SIGTERM when
  /// this is detected, so that its run ends after the current step; an `Interruption` must exist.
  [[nodiscard]] bool is_lost() const;

 private:
  Claim(std::unique_ptr<DirectoryLock> lock, const std::filesystem::path& directory, int number,
        std::chrono::milliseconds renewal);
  void renew(const std::stop_token& stop, std::chrono::milliseconds interval) const;

  std::unique_ptr<DirectoryLock> lock_;  ///< null if the file system has no locks
  std::filesystem::path file_, next_;
  std::jthread renewal_;
};

}  // namespace vehd
