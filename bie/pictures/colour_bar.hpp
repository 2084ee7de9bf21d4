#pragma once

#include <string>
#include <vector>

#include "bie/pictures/colours.hpp"
#include "bie/pictures/page.hpp"

namespace vehd {

/// A colour bar with its ticks, before it is placed on a page.
struct ColourBar {
  ColourRange range;               ///< in the unit shown
  std::vector<double> ticks;       ///< at least three
  std::vector<std::string> texts;  ///< one for each tick
  std::vector<std::string> title;  ///< lines above the bar
};

/// @param name  of the field; the unit and a power of ten follow on a separate line
ColourBar colour_bar(const ColourRange& range, const std::string& name, const std::string& unit);

/// Width of the bar with its texts, in points.
double width_of(const ColourBar& bar);

void draw_colour_bar(Page& page, const ColourBar& bar, const ColourMap& colours, const Box& box);

}  // namespace vehd
