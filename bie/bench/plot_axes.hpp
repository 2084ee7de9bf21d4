#pragma once

#include <array>
#include <string>
#include <vector>

#include "bie/bench/picture.hpp"
#include "bie/pictures/page.hpp"

/// Where things are within the axes of one panel, in points.
namespace vehd {

/// A scale from numbers to points.
struct PlotScale {
  double lower = 1.0, upper = 10.0;
  bool logarithmic = true;
  double length = 100.0;  ///< points

  [[nodiscard]] double place(double value) const;
};

struct PlotAxes {
  PlotScale x, y;
};

/// Axes that hold all curves and slopes of a panel; logarithmic ones of y end at powers of ten.
PlotAxes axes_of(const BenchPanel& panel, double width, double height);

/// A note that has found its place.
struct PlacedNote {
  std::string text;
  PagePoint at{};  ///< of its middle, in points from the lower left corner of the axes
  int colour = 0;  ///< of its curve; -1: of a slope
};

/// Notes beside their points where they meet neither each other nor a point nor a curve; those that find no such place
/// are left out.
std::vector<PlacedNote> place_notes(const BenchPanel& panel, const PlotAxes& axes, double font);

}  // namespace vehd
