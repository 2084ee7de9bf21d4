#pragma once

#include <map>
#include <string>

namespace vehd {

/// Version of this program.
std::string program_version();

/// Commit of the source tree at build time, with "-dirty" if files had changed; empty if git could not determine it.
std::string program_commit();

/// Versions of the libraries that results depend on, by name, and the compiler with its instruction set.
std::map<std::string, std::string> library_versions();

}  // namespace vehd
