#pragma once

#include <map>
#include <string>

namespace vehd {

/// Version of this program.
std::string program_version();

/// Versions of the libraries that results depend on, by name.
std::map<std::string, std::string> library_versions();

}  // namespace vehd
