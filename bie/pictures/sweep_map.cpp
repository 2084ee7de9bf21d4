#include "bie/pictures/sweep_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/pictures/colour_bar.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {
namespace {

/// Distinct values of a key, in the order of the rows.
std::vector<std::string> values_of_key(const SweepRows& rows, std::size_t key) {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < rows.n_rows(); ++row) {
    if (std::ranges::find(values, rows.cells[row][key]) == values.end()) values.push_back(rows.cells[row][key]);
  }
  return values;
}

/// One column on its grid of cells.
class SweepCells {
 public:
  SweepCells(const SweepRows& rows, std::size_t column, const Box& box)
      : rows_(rows),
        column_(column),
        box_(box),
        nx_(values_of_key(rows, 0).size()),
        ny_(values_of_key(rows, 1).size()) {}

  [[nodiscard]] std::size_t nx() const { return nx_; }
  [[nodiscard]] std::size_t ny() const { return ny_; }
  [[nodiscard]] std::size_t row(std::size_t i, std::size_t j) const { return i * ny_ + j; }
  [[nodiscard]] double value(std::size_t i, std::size_t j) const { return rows_.number(row(i, j), column_); }
  [[nodiscard]] bool is_completed(std::size_t i, std::size_t j) const { return rows_.is_completed(row(i, j)); }
  /// Lower left corner of cell (i, j).
  [[nodiscard]] PagePoint corner(std::size_t i, std::size_t j) const {
    return box_.at(static_cast<double>(i) / static_cast<double>(nx_),
                   static_cast<double>(j) / static_cast<double>(ny_));
  }

  [[nodiscard]] ColourRange range() const {
    const auto [least, most] = finite_range(rows_.numbers(column_));
    if (!std::isfinite(least)) return {0.0, 1.0};
    ColourRange range{least, most};
    range.both_signs = range.lower < 0.0 && range.upper > 0.0;
    if (range.both_signs) range.lower = -(range.upper = std::max(range.upper, -range.lower));
    const double about = room_around_constant(range.lower, range.upper);
    range.lower -= about;
    range.upper += about;
    return range;
  }

 private:
  const SweepRows& rows_;
  std::size_t column_;
  Box box_;
  std::size_t nx_, ny_;
};

void draw_cells(Page& page, const SweepCells& cells, const ColourRange& range, const ColourMap& colours) {
  for (std::size_t i = 0; i < cells.nx(); ++i) {
    for (std::size_t j = 0; j < cells.ny(); ++j) {
      const double value = cells.value(i, j);
      const PagePoint low = cells.corner(i, j);
      const PagePoint high = cells.corner(i + 1, j + 1);
      if (std::isfinite(value)) {
        const double share = (value - range.lower) / (range.upper - range.lower);
        // The next cell is drawn over the overlap, which hides the seam.
        constexpr double seam = 0.4;
        const double right = i + 1 < cells.nx() ? high[0] + seam : high[0];
        const double top = j + 1 < cells.ny() ? high[1] + seam : high[1];
        page.areas.push_back({Box{low[0], low[1], right, top}.corners(), hex_of(colours.at(share))});
      }
      if (cells.is_completed(i, j)) continue;
      const PagePoint middle{0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1])};
      const double arm = 0.2 * std::min(high[0] - low[0], high[1] - low[1]);
      for (const double side : {-1.0, 1.0}) {
        page.lines.push_back({{{middle[0] - arm, middle[1] - side * arm}, {middle[0] + arm, middle[1] + side * arm}},
                              0.6,
                              "#7a7a7a",
                              false});
      }
    }
  }
}

/// Draws the edges of cells between which the column crosses the value.
void draw_border(Page& page, const SweepCells& cells, double border) {
  const auto differ = [&](double a, double b) {
    return std::isfinite(a) && std::isfinite(b) && (a < border) != (b < border);
  };
  for (std::size_t i = 0; i < cells.nx(); ++i) {
    for (std::size_t j = 0; j < cells.ny(); ++j) {
      const double value = cells.value(i, j);
      if (i + 1 < cells.nx() && differ(value, cells.value(i + 1, j))) {
        page.lines.push_back({{cells.corner(i + 1, j), cells.corner(i + 1, j + 1)}, 1.6, "#000000", false});
      }
      if (j + 1 < cells.ny() && differ(value, cells.value(i, j + 1))) {
        page.lines.push_back({{cells.corner(i, j + 1), cells.corner(i + 1, j + 1)}, 1.6, "#000000", false});
      }
    }
  }
}

}  // namespace

std::optional<double> usual_border(const std::string& header, double least, double most) {
  if (header.starts_with("aspect_ratio_field")) return 1.0;
  if (least < 0.0 && most > 0.0) return 0.0;
  return std::nullopt;
}

void draw_sweep_map(const SweepRows& rows, std::size_t column, std::optional<double> border,
                    const std::vector<SweepCurve>& curves, const PictureFile& picture) {
  const Box box{50.0, 38.0, 250.0, 222.0};
  Page page{0.0, 250.0};
  const SweepCells cells(rows, column, box);
  const ColourRange range = cells.range();
  if (!border) border = usual_border(rows.columns[column], range.lower, range.upper);
  const double white = border ? (*border - range.lower) / (range.upper - range.lower) : 0.0;
  const ColourMap colours = white > 0.0 && white < 1.0 ? ColourMap::diverging(white) : ColourMap::sequential();
  draw_cells(page, cells, range, colours);
  if (border) draw_border(page, cells, *border);
  for (const SweepCurve& curve : curves) {
    PageLine line{{}, 1.6, "#d62728", false};
    for (const PagePoint& at : curve) {
      line.points.push_back(box.at(at[0], at[1]));
    }
    // A white edge separates the curve from red cells.
    PageLine edge = line;
    edge.width = 3.2;
    edge.colour = "#ffffff";
    page.lines.push_back(std::move(edge));
    page.lines.push_back(std::move(line));
  }
  draw_sweep_frame(page, box, axis_of_cells(rows.keys[0].name, values_of_key(rows, 0)),
                   axis_of_cells(rows.keys[1].name, values_of_key(rows, 1)), false);
  const std::string& header = rows.columns[column];
  const std::string label = column_label(header);
  const std::size_t at = label.find(" (");
  const std::string unit = at == std::string::npos ? "" : label.substr(at + 2, label.size() - at - 3);
  const ColourBar bar = colour_bar(range, label.substr(0, at), unit);
  constexpr double bar_left = 268.0, margin = 10.0;
  page.width = bar_left + width_of(bar) + margin;
  draw_colour_bar(page, bar, colours, {bar_left, box.bottom, page.width - margin, box.top + 12.0});
  draw_page(page, picture);
}

}  // namespace vehd
