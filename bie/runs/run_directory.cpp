#include "bie/runs/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace vehd {

DirectoryLock::DirectoryLock(const std::filesystem::path& lock_file)
    : descriptor_(::open(lock_file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
  const std::string directory = lock_file.parent_path().string();
  if (descriptor_ < 0) {
    throw InputError(fmt::format("{}: cannot be written: {}", directory, std::strerror(errno)));
  }
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) != 0) {
    const int problem = errno;
    ::close(descriptor_);
    if (problem == EWOULDBLOCK) {
      throw DirectoryBusy(
          fmt::format("{}: another run is writing in this directory; wait for it or choose another -o", directory));
    }
    throw NoLocks(fmt::format("{}: cannot be locked against a second run: {}; choose an -o on a file system with flock",
                              directory, std::strerror(problem)));
  }
}

DirectoryLock::~DirectoryLock() { ::close(descriptor_); }

bool admit_run(const RunPaths& paths, bool resume) {
  const bool resumable = std::filesystem::exists(paths.checkpoint());
  if (resume && resumable) return true;
  for (const auto& file : {paths.checkpoint(), paths.history(), paths.history_error(), paths.vesicles(),
                           paths.snapshots(), paths.xdmf(), paths.summary(), paths.scene()}) {
    if (!std::filesystem::exists(file)) continue;
    if (resume) {
      throw InputError(
          fmt::format("{}: holds a run ({}) without checkpoint.h5, which cannot be resumed; "
                      "choose another -o",
                      paths.directory.string(), file.filename().string()));
    }
    throw InputError(fmt::format("{}: already holds a run ({}); continue it with --resume or choose another -o",
                                 paths.directory.string(), file.filename().string()));
  }
  return false;
}

}  // namespace vehd
