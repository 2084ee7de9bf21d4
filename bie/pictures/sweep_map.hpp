#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/pictures/sweep_frame.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

/// Value at which a column with this range changes its meaning: 1 of a ratio of lengths, 0 of a column of both signs.
std::optional<double> usual_border(const std::string& header, double least, double most);

/// A map of one column over a grid of two keys: the last key upwards.
/// @param border  value at which a border is shown; absent: 1 of a ratio of lengths, 0 of a column of both signs
/// @param curves  drawn over it
void draw_sweep_map(const SweepRows& rows, std::size_t column, std::optional<double> border,
                    const std::vector<SweepCurve>& curves, const PictureFile& picture);

}  // namespace vehd
