#include "bie/pictures/sweep_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/pictures/colour_bar.hpp"
#include "bie/pictures/labels.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {
namespace {

constexpr double sweep_text = 8.0, sweep_tick = 3.0;

std::string hex_of(const Colour& colour) {
  const auto byte = [](double c) { return static_cast<int>(std::lround(255.0 * c)); };
  return fmt::format("#{:02x}{:02x}{:02x}", byte(colour[0]), byte(colour[1]), byte(colour[2]));
}

/// Different values of a key, in the order of the rows.
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
  /// Of a corner: that of cell (i, j) to the lower left.
  [[nodiscard]] PagePoint corner(std::size_t i, std::size_t j) const {
    return {box_.left + box_.width() * static_cast<double>(i) / static_cast<double>(nx_),
            box_.bottom + box_.height() * static_cast<double>(j) / static_cast<double>(ny_)};
  }

  [[nodiscard]] ColourRange range() const {
    ColourRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (std::size_t row = 0; row < rows_.n_rows(); ++row) {
      const double number = rows_.number(row, column_);
      if (!std::isfinite(number)) continue;
      range.lower = std::min(range.lower, number);
      range.upper = std::max(range.upper, number);
    }
    if (!std::isfinite(range.lower)) return {0.0, 1.0};
    range.both_signs = range.lower < 0.0 && range.upper > 0.0;
    if (range.both_signs) range.lower = -(range.upper = std::max(range.upper, -range.lower));
    constexpr double rounding = 1e-9;
    const double size = std::max(std::abs(range.lower), std::abs(range.upper));
    if (range.upper - range.lower <= rounding * size) {
      const double about = size > 0.0 ? 0.1 * size : 1.0;
      range.lower -= about;
      range.upper += about;
    }
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
        // The next cell lies above the seam.
        constexpr double seam = 0.4;
        const double right = i + 1 < cells.nx() ? high[0] + seam : high[0];
        const double top = j + 1 < cells.ny() ? high[1] + seam : high[1];
        page.areas.push_back({{low, {right, low[1]}, {right, top}, {low[0], top}}, hex_of(colours.at(share))});
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

/// The edges of cells between which the column passes the value.
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

/// As an area: lines would lie above the points.
void draw_pale_line(Page& page, const Box& line) {
  page.areas.push_back(
      {{{line.left, line.bottom}, {line.right, line.bottom}, {line.right, line.top}, {line.left, line.top}},
       "#e4e4e4"});
}

}  // namespace

std::optional<double> usual_border(const std::string& header, double least, double most) {
  if (header.starts_with("aspect_ratio_field")) return 1.0;
  if (least < 0.0 && most > 0.0) return 0.0;
  return std::nullopt;
}

std::string column_label(const std::string& header) {
  const std::size_t at = header.find(" [");
  if (at == std::string::npos) return column_title(header);
  return with_unit(column_title(header.substr(0, at)), header.substr(at + 2, header.size() - at - 3));
}

void draw_sweep_frame(Page& page, const Box& box, const SweepAxis& x, const SweepAxis& y, bool grid) {
  for (const SweepTick& tick : x.ticks) {
    const double place = box.left + tick.place * box.width();
    if (grid) draw_pale_line(page, {place - 0.25, box.bottom, place + 0.25, box.top});
    page.lines.push_back({{{place, box.bottom}, {place, box.bottom - sweep_tick}}, 0.5, "#000000", false});
    page.texts.push_back({tick.text, {place, box.bottom - 9.0}, sweep_text, TextAnchor::centre, "#000000"});
  }
  for (const SweepTick& tick : y.ticks) {
    const double place = box.bottom + tick.place * box.height();
    if (grid) draw_pale_line(page, {box.left, place - 0.25, box.right, place + 0.25});
    page.lines.push_back({{{box.left, place}, {box.left - sweep_tick, place}}, 0.5, "#000000", false});
    page.texts.push_back({tick.text, {box.left - sweep_tick - 2.0, place}, sweep_text, TextAnchor::right, "#000000"});
  }
  page.lines.push_back({{{box.left, box.bottom},
                         {box.right, box.bottom},
                         {box.right, box.top},
                         {box.left, box.top},
                         {box.left, box.bottom}},
                        0.6,
                        "#000000",
                        false});
  page.texts.push_back(
      {x.label, {0.5 * (box.left + box.right), box.bottom - 23.0}, sweep_text, TextAnchor::centre, "#000000"});
  page.texts.push_back({y.label, {box.left - 30.0, box.top + 10.0}, sweep_text, TextAnchor::left, "#000000"});
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
      line.points.push_back({box.left + at[0] * box.width(), box.bottom + at[1] * box.height()});
    }
    // A white edge tells it from red cells.
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
