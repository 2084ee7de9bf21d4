#pragma once

#include <string>
#include <vector>

#include "bie/pictures/page.hpp"

namespace vehd {

/// A tick of an axis.
struct SweepTick {
  double place = 0.0;  ///< 0 ... 1 along the axis
  std::string text;
};

/// One axis of a picture of a sweep.
struct SweepAxis {
  std::string label;
  std::vector<double> places;  ///< of the values, 0 ... 1 along the axis
  std::vector<SweepTick> ticks;
};

/// Axis of the values of a key as its table shows them ("0.5", "10 kHz", "shear"). Numbers of one unit are placed by
/// value, or by logarithm if requested; other values side by side. Vectors that differ in one component are that
/// number.
SweepAxis axis_of_values(const std::string& key, const std::vector<std::string>& written, bool is_logarithmic);

/// Axis of cells of equal size, one for each value in the given order. Many values with even steps, or with even steps
/// of their logarithms, get ticks at round numbers.
SweepAxis axis_of_cells(const std::string& key, const std::vector<std::string>& written);

/// Axis of numbers with some room at both ends; NaN stays NaN.
SweepAxis axis_of_numbers(const std::string& label, const std::vector<double>& values);

/// A page of line plots of equal size, in two columns.
struct SweepPanels {
  Page page;

  explicit SweepPanels(std::size_t count);
  /// Frame of one plot.
  [[nodiscard]] Box box(std::size_t panel) const;

 private:
  std::size_t across_;
};

/// A data point as an octagon.
PageArea sweep_dot(const PagePoint& at, const char* colour);

/// Label of a column: "time (ms)" of "time [ms]".
std::string column_label(const std::string& header);

/// Draws the frame of a plot with ticks, the label of x below it and that of y above its left corner.
/// @param grid  draws pale lines through the ticks
void draw_sweep_frame(Page& page, const Box& box, const SweepAxis& x, const SweepAxis& y, bool grid);

}  // namespace vehd
