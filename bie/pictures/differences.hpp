#pragma once

#include <filesystem>

namespace vehd {

/// DIR/differences.dat: text, columns named in the first line, one block of lattice lines for every face.
std::filesystem::path differences_file(const std::filesystem::path& directory);

/// Draws DIR/differences.png, the differences of both methods on the membrane, from the data file that the
/// finite-element side left in DIR.
/// @return false if it left none
/// @throws InputError if gnuplot is missing or reports an error
bool draw_differences(const std::filesystem::path& directory);

}  // namespace vehd
