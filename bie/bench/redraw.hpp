#pragma once

#include <filesystem>
#include <vector>

namespace vehd {

/// Draws NAME.png beside NAME.csv, the table of an earlier bench.
/// @return the picture; empty where the bench has none
/// @throws InputError if the file cannot be read, or if gnuplot is missing or reports an error
std::filesystem::path draw_record(const std::filesystem::path& csv);

/// Draws the pictures of all benches whose tables are in a folder, of the hard cases whose runs are in its
/// stability/runs, and renews those that pages show.
/// @param docs  folder of the pages; empty: none
/// @return the pictures
/// @throws InputError if there is no table in the folder, and as draw_record
std::vector<std::filesystem::path> redraw(const std::filesystem::path& folder, const std::filesystem::path& docs);

}  // namespace vehd
