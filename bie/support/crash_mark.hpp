#pragma once

#include <filesystem>

namespace vehd {

/// While alive, a crash of the process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) renames a file before the process
/// ends by that signal. One at a time.
class CrashMark {
 public:
  /// @param stem  the new name; the number of the signal follows it
  CrashMark(const std::filesystem::path& file, const std::filesystem::path& stem);
  ~CrashMark();
  CrashMark(const CrashMark&) = delete;
  CrashMark& operator=(const CrashMark&) = delete;
};

}  // namespace vehd
