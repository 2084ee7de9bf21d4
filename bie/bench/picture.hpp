#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vehd {

/// Column y against column x of a CSV file.
struct BenchCurve {
  std::string label;
  std::string x, y;
  std::string key{}, value{};  ///< only rows whose column `key` holds `value`; empty key: all rows
  std::string note{};          ///< column that is written beside each point; empty: none
  int colour = 0;
  bool dashed = false;
};

/// Axes are logarithmic but for the x of a straight panel.
struct BenchPanel {
  std::string x_label, y_label;
  std::vector<BenchCurve> curves;
  bool straight_x = false;
  std::vector<double> x_ticks{};          ///< ascending; they bound the axis; empty: gnuplot's choice
  std::string key_place = "bottom left";  ///< in gnuplot's words; empty: no key
};

/// Panels side by side as a PNG. @throws InputError if gnuplot is missing or reports an error
void draw_bench(const std::filesystem::path& csv, const std::vector<BenchPanel>& panels,
                const std::filesystem::path& picture);

}  // namespace vehd
