#include "bie/runs/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>
#include <vector>

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

namespace {

/// Sweeps and fits would take the files of a run for their own.
void refuse_sweeps_and_fits(const std::filesystem::path& directory) {
  std::vector<std::filesystem::path> files{directory / "sweep.json", directory / "fit.json", directory / "runs"};
  std::error_code ignored;
  if (std::filesystem::equivalent(directory, directory / "../runs", ignored)) {
    files.insert(files.end(), {directory / "../sweep.json", directory / "../fit.json"});
  }
  for (const auto& file : files) {
    if (!std::filesystem::exists(file)) continue;
    throw InputError(fmt::format("{}: belongs to a sweep or a fit ({}); choose another -o", directory.string(),
                                 file.filename().string()));
  }
}

}  // namespace

bool admit_run(const RunPaths& paths, bool resume) {
  const bool resumable = std::filesystem::exists(paths.checkpoint());
  if (resume && resumable) return true;
  refuse_sweeps_and_fits(paths.directory);
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
