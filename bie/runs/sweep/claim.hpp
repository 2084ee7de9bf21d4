#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <thread>

#include "bie/runs/run_directory.hpp"

namespace vehd {

/// The right to work at a run of a sweep, until destruction.
///
/// On one machine it is the lock of the run directory, which ends with the process that has it. The locks of a file
/// system that machines share may reach no further than each of them, and some file systems have none. So whoever has
/// the lock also adds a file to the directory: claim.1, the next one claim.2, and so on. Of several workers that create
/// the same one, one succeeds. The last one counts. It names the machine, and its worker renews its time. It is void if
/// it is from this machine, where the lock was free, or older than 300 s by the clock of the file system.
class Claim {
 public:
  /// @param directory  of the run; created if it is missing
  /// @param renewal    time between renewals
  /// @return           null if another worker has the run
  /// @throws OutputError, std::filesystem::filesystem_error if the directory cannot be used
  static std::unique_ptr<Claim> take(const std::filesystem::path& directory,
                                     std::chrono::milliseconds renewal = std::chrono::seconds(20));
  /// Other workers need not wait.
  ~Claim();
  Claim(const Claim&) = delete;
  Claim& operator=(const Claim&) = delete;

  /// Another worker has a later claim, since this process was suspended. The process has got a SIGTERM when this was
  /// noticed, so that its run ends after the step in hand; an `Interruption` must be alive.
  [[nodiscard]] bool is_lost() const;

 private:
  Claim(std::unique_ptr<DirectoryLock> lock, const std::filesystem::path& directory, int number,
        std::chrono::milliseconds renewal);
  void renew(const std::stop_token& stop, std::chrono::milliseconds interval) const;

  std::unique_ptr<DirectoryLock> lock_;  ///< null where the file system has none
  std::filesystem::path file_, next_;
  std::jthread renewal_;
};

}  // namespace vehd
