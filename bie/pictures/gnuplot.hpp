#pragma once

#include <filesystem>
#include <string>

namespace vehd {

/// Runs gnuplot on a script in the given folder, where relative file names of the script start.
/// @throws InputError if gnuplot is missing or reports an error
void run_gnuplot(const std::string& script, const std::filesystem::path& folder);

/// A file name as a gnuplot string.
std::string gnuplot_quoted(const std::string& text);

/// A name that gnuplot prints as it is: it would lower what follows an underscore.
std::string gnuplot_literal(const std::string& text);

}  // namespace vehd
