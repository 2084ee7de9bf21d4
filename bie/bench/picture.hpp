#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"

namespace vehd {

/// How a curve is drawn: a whole over its parts is wide and pale and lies below them, so that it hides none.
enum class CurveKind { line, dashed, wide };

/// Points joined by a line.
struct BenchCurve {
  std::string label;  ///< in the key, once for all panels
  std::vector<double> x, y;
  std::vector<std::string> notes{};  ///< beside the points; empty: none
  int colour = 0;
  CurveKind kind = CurveKind::line;
};

/// A thin line y = a x^exponent, from one x to another.
struct BenchSlope {
  std::string label;
  double exponent = 1.0;
  double x_from = 1.0, x_to = 10.0;
  double y_from = 1.0;
};

/// Groups of bars.
struct BenchBars {
  std::vector<std::string> groups, bars;    ///< names; those of bars are in the key
  std::vector<std::vector<double>> values;  ///< of each group, for each bar
  std::vector<std::string> notes;           ///< above each group
};

/// Axes are logarithmic but for the x of a straight panel and for bars.
struct BenchPanel {
  std::string x_label, y_label;
  std::vector<BenchCurve> curves{};
  std::vector<BenchSlope> slopes{};
  bool straight_x = false;
  std::vector<double> x_ticks{};  ///< ascending; empty: powers of ten
  BenchBars bars{};               ///< in place of curves
};

/// A line of this exponent beside the last points of a curve, at `factor` of the last.
BenchSlope slope_beside(const BenchCurve& curve, double exponent, const std::string& label, double factor,
                        std::size_t n_points = 3);

/// Panels side by side and the key to their right, as a PNG.
/// @throws InputError if gnuplot is missing or reports an
/// error
void draw_bench(const std::vector<BenchPanel>& panels, const std::filesystem::path& picture);

/// A scale from numbers to points within the axes of a panel.
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
