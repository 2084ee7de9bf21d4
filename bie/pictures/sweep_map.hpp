#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/pictures/sweep_axis.hpp"
#include "bie/pictures/sweep_curves.hpp"
#include "bie/pictures/sweep_rows.hpp"

namespace vehd {

/// Label of a column: "time (ms)" of "time [ms]".
std::string column_label(const std::string& header);

/// Value at which a column with this range changes its meaning: 1 of a ratio of lengths, 0 of a column of both signs.
std::optional<double> usual_border(const std::string& header, double least, double most);

/// The frame of a plot with ticks, the label of x below and that of y above its left corner.
/// @param grid  whether pale lines go through the ticks
void draw_sweep_frame(Page& page, const Box& box, const SweepAxis& x, const SweepAxis& y, bool grid);

/// A map of one column over a grid of two keys: the last key upwards.
/// @param border  value at which a border is shown; absent: 1 of a ratio of lengths, 0 of a column of both signs
/// @param curves  drawn over it
void draw_sweep_map(const SweepRows& rows, std::size_t column, std::optional<double> border,
                    const std::vector<SweepCurve>& curves, const PictureFile& picture);

}  // namespace vehd
