#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vehd {

/// Where to start a program. An archive of vehd carries gnuplot and mpirun (bie/cmake/archive.cmake), in the folder
/// `programs` beside its libraries: then this is their path, and the variables by which they, and the finite elements,
/// find fonts and plugins of the archive are set. Elsewhere it is the name, which stands for a program of PATH.
std::filesystem::path place_of_program(const std::string& name);

/// @param libraries  folder that has the libraries of vehd
std::filesystem::path place_of_program(const std::string& name, const std::filesystem::path& libraries);

/// A program to start. It has no input.
struct ChildProgram {
  std::vector<std::string> words;  ///< its name, looked for by place_of_program(), and its arguments
  std::filesystem::path output;    ///< takes its standard output and error; empty: they go where those of this one go
  std::filesystem::path folder{};  ///< its working directory; empty: that of this one
};

/// How it ended.
struct ChildEnd {
  int start_problem = 0;  ///< errno, if it could not be started
  int exit_code = 0;
  int signal = 0;  ///< that ended it, if one did
};

/// Runs a program to its end. Nothing of it outlives this process, whatever ends that, nor its own end: all that it has
/// started, in whichever process group or session, gets most of a second to end by itself and is killed then.
///
/// A process between the two sees to that. It is out of reach of what is sent to the terminal or to the process group
/// of this program; of a Ctrl-C it learns because it ends this program.
ChildEnd run_child(const ChildProgram& program);

}  // namespace vehd
