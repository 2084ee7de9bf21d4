#pragma once

#include <filesystem>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

/// Points in a map of two keys, each 0 ... 1 of its width and height.
using SweepCurve = std::vector<PagePoint>;

/// Curves to be drawn over a map: known borders, or measurements. The file is CSV, its header names both
/// keys, in any order, and its values have the units of the table; an empty line begins another curve. Values of a map
/// stand in the middle of their cells, those between them by even steps, or by even factors where the sweep has them.
/// A curve ends where it leaves the map.
/// @throws InputError "file:line: what is wrong"; if a key has values that are no numbers of one unit
std::vector<SweepCurve> read_sweep_curves(const std::filesystem::path& path, const SweepRows& rows);

}  // namespace vehd
