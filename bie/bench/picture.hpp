#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"

namespace vehd {

/// Style of a curve: `wide` for a whole over its parts, pale and below them, so that it hides none.
enum class CurveKind { line, dashed, wide };

/// Points joined by a line.
struct BenchCurve {
  std::string label;  ///< in the key, once for all panels
  std::vector<double> x, y;
  std::vector<std::string> notes{};  ///< beside the points; empty: none
  int colour = 0;
  CurveKind kind = CurveKind::line;
};

/// A thin line y = a x^exponent from x_from to x_to.
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

/// Axes are logarithmic, except for the x axis of a straight panel and for bars.
struct BenchPanel {
  std::string x_label, y_label;
  std::vector<BenchCurve> curves{};
  std::vector<BenchSlope> slopes{};
  bool straight_x = false;
  std::vector<double> x_ticks{};  ///< ascending; empty: powers of ten
  BenchBars bars{};               ///< instead of curves
};

/// A line of this exponent beside the last n_points points of a curve, at `factor` times the last.
BenchSlope slope_beside(const BenchCurve& curve, double exponent, const std::string& label, double factor,
                        std::size_t n_points = 3);

/// Draws panels side by side and the key to their right, as a PNG.
/// @throws InputError if gnuplot is missing or reports an error
void draw_bench(const std::vector<BenchPanel>& panels, const std::filesystem::path& picture);

/// Maps numbers to points (1/72 inch) along an axis of a panel.
struct PlotScale {
  double lower = 1.0, upper = 10.0;
  bool logarithmic = true;
  double length = 100.0;  ///< points

  [[nodiscard]] double place(double value) const;
};

struct PlotAxes {
  PlotScale x, y;
};

/// Axes that contain all curves and slopes of a panel; that of y ends at powers of ten.
PlotAxes axes_of(const BenchPanel& panel, double width, double height);

/// A note with its position.
struct PlacedNote {
  std::string text;
  PagePoint at{};  ///< of its middle, in points from the lower left corner of the axes
  int colour = 0;  ///< of its curve; -1: of a slope
};

/// Notes beside their points, placed such that they overlap neither each other nor a point nor a curve; notes without
/// such a place are left out.
std::vector<PlacedNote> place_notes(const BenchPanel& panel, const PlotAxes& axes, double font);

}  // namespace vehd
