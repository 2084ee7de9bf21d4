#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/pictures/sweep_frame.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

/// Value at which a column with this range changes its meaning: 1 of the aspect ratio along the field, 0 of both signs.
std::optional<double> usual_border(const std::string& header, double least, double most);

/// Draws a map of one column over a grid of two keys, the last key upwards.
/// @param border  value at which a border is shown; absent: usual_border
/// @param curves  drawn over the map
void draw_sweep_map(const SweepRows& rows, std::size_t column, std::optional<double> border,
                    const std::vector<SweepCurve>& curves, const PictureFile& picture);

}  // namespace vehd
