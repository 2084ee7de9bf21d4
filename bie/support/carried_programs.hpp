#pragma once

#include <filesystem>
#include <string>

namespace vehd {

/// Where to start a program. An archive of vehd carries gnuplot and mpirun (bie/cmake/archive.cmake), in the folder
/// `programs` beside its libraries: then this is their path, and the variables by which they, and the finite elements,
/// find fonts and plugins of the archive are set. Elsewhere it is the name, which stands for a program of PATH.
std::filesystem::path place_of_program(const std::string& name);

/// @param libraries  folder that has the libraries of vehd
std::filesystem::path place_of_program(const std::string& name, const std::filesystem::path& libraries);

}  // namespace vehd
