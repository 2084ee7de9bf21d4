#pragma once

#include <string>
#include <vector>

#include "bie/pictures/colours.hpp"
#include "bie/pictures/page.hpp"

namespace vehd {

/// A colour bar that has its ticks but no place yet.
struct ColourBar {
  ColourRange range;               ///< in the unit that is shown
  std::vector<double> ticks;       ///< at least three
  std::vector<std::string> texts;  ///< one for each
  std::vector<std::string> title;  ///< lines above the bar
};

/// @param name  of the field; the unit and a power of ten follow on a line of their own
ColourBar colour_bar(const ColourRange& range, const std::string& name, const std::string& unit);

/// Room that the bar and its texts take, in points.
double width_of(const ColourBar& bar);

void draw_colour_bar(Page& page, const ColourBar& bar, const ColourMap& colours, const Box& box);

}  // namespace vehd
