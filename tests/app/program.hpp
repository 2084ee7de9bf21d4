#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/files.hpp"
#include "tests/support/scenes.hpp"

/// Result of the real binary, run as users run it.
struct ProgramResult {
  int exit_code = -1;  ///< -1: ended by a signal
  long peak_kilobytes = 0;
  std::string output;
  std::string errors;
};

/// A started program. Destruction kills it if it still runs.
class RunningProgram {
 public:
  explicit RunningProgram(const std::vector<std::string>& command);
  ~RunningProgram();
  RunningProgram(const RunningProgram&) = delete;
  RunningProgram& operator=(const RunningProgram&) = delete;

  void send(int signal) const;
  [[nodiscard]] bool ended();
  ProgramResult wait();

 private:
  void collect(int options);

  pid_t process_ = 0;
  bool ended_ = false;
  int status_ = 0;
  long peak_kilobytes_ = 0;
  TemporaryDirectory files_;
  std::string output_ = files_ / "output", errors_ = files_ / "errors";
};

/// Runs `vehd` with these arguments to its end.
ProgramResult run_vehd(const std::vector<std::string>& arguments);
ProgramResult run_command(const std::vector<std::string>& command);
/// A Python that has these modules ("h5py, numpy"): the one of PATH or that of the system; empty if neither has them.
std::string python_with(const std::string& modules);
std::vector<std::string> vehd_command(const std::vector<std::string>& arguments);

/// Copies two scenes of tests/hard/scenes to the same place below `tree`.
void copy_some_hard_cases(const std::filesystem::path& tree);
