#pragma once

#include <map>
#include <string>

namespace vehd {

/// Version of this program.
std::string program_version();

/// Commit of the source tree at build time, "-dirty" with changes on top of it; empty where git did not know.
std::string program_commit();

/// Versions of the libraries that results depend on, by name, and the compiler with the instruction set it was given.
std::map<std::string, std::string> library_versions();

}  // namespace vehd
