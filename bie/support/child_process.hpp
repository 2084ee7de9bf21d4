#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vehd {

/// Path or name by which to start a program. An archive of vehd (bie/cmake/archive.cmake) has gnuplot and mpirun in the
/// folder `programs` beside its libraries: then their path, and the environment variables by which they and the finite
/// elements find fonts and plugins of the archive are set. Otherwise the name, to be looked up in PATH.
std::filesystem::path program_path(const std::string& name);

/// @param libraries  folder of the libraries of vehd
std::filesystem::path program_path(const std::string& name, const std::filesystem::path& libraries);

/// A program to start. Its standard input is empty.
struct ChildProgram {
  std::vector<std::string> words;  ///< its name, resolved by program_path(), and its arguments
  std::filesystem::path output;    ///< file for its standard output and error; empty: those of this process
  std::filesystem::path folder{};  ///< its working directory; empty: that of this process
};

/// Outcome of a child process.
struct ChildEnd {
  int start_problem = 0;  ///< errno, if it could not be started
  int exit_code = 0;
  int signal = 0;  ///< that ended it; 0: none
};

/// Runs a program to its end. No process that it starts, in whichever process group or session, outlives the program or
/// this process, however either ends: what is left gets 0.8 s to end by itself and is then killed.
///
/// A guardian process between the two ensures this. It is in a session of its own, out of reach of signals from the
/// terminal or to the process group of this program; after Ctrl-C it acts because this program ends.
ChildEnd run_child(const ChildProgram& program);

}  // namespace vehd
