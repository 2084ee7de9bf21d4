#include "bie/pictures/shapes_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vehd {
namespace {

constexpr double margin = 5.0, gap = 10.0;
/// Largest ratio of the height of a page to its width.
constexpr double tallest = 0.55;
constexpr double least_bar_height = 84.0, highest_bar = 170.0;
/// A further row is used only if it enlarges the shapes by this factor.
constexpr double worth_a_row = 1.25;
constexpr double largest_cell = 190.0;

double sum_of(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

/// A number of rows and a position of the key, with the resulting sizes.
struct Arrangement {
  const ShapesContent& content;
  std::size_t n_rows;
  bool key_below;
  std::vector<double> widths, heights;  ///< of columns and rows, in units of the scene
  double scale = 0.0;                   ///< points per length of the scene

  Arrangement(const ShapesContent& all, std::size_t rows, bool below)
      : content(all), n_rows(rows), key_below(below), widths(columns()), heights(rows) {
    double largest = 0.0;
    for (std::size_t i = 0; i < content.half_extents.size(); ++i) {
      const auto& [half_width, half_height] = content.half_extents[i];
      widths[i % columns()] = std::max(widths[i % columns()], 2.0 * half_width);
      heights[i / columns()] = std::max(heights[i / columns()], 2.0 * half_height);
      largest = std::max({largest, 2.0 * half_width, 2.0 * half_height});
    }
    const double across = content.page_width - 2.0 * margin - beside() - static_cast<double>(columns()) * gap;
    const double down =
        tallest * content.page_width - 2.0 * margin - key_row() - static_cast<double>(n_rows) * shape_label_height;
    scale = std::min({across / sum_of(widths), down / sum_of(heights), largest_cell / largest});
  }

  [[nodiscard]] std::size_t columns() const { return (content.half_extents.size() + n_rows - 1) / n_rows; }
  [[nodiscard]] double bar() const { return content.bar_width > 0.0 ? content.bar_width + gap : 0.0; }
  [[nodiscard]] double key_column() const {
    return key_below || content.key_heights.empty() ? 0.0 : content.key_width + gap;
  }
  [[nodiscard]] double beside() const { return key_column() + bar(); }
  [[nodiscard]] double key_row() const {
    return key_below && !content.key_heights.empty() ? gap + std::ranges::max(content.key_heights) : 0.0;
  }
  [[nodiscard]] double key_height() const { return sum_of(content.key_heights); }
  [[nodiscard]] double key_row_width() const {
    return static_cast<double>(content.key_heights.size()) * content.key_width;
  }
  [[nodiscard]] double column_width(std::size_t column) const {
    return std::max(widths[column] * scale, content.label_width) + gap;
  }
  [[nodiscard]] double shapes_width() const {
    double width = 0.0;
    for (std::size_t column = 0; column < columns(); ++column) width += column_width(column);
    return width;
  }
  [[nodiscard]] double shapes_height() const {
    return sum_of(heights) * scale + static_cast<double>(n_rows) * shape_label_height;
  }

  /// Scale of the shapes, reduced by factors for unused room, for further rows and for excess width.
  [[nodiscard]] double score() const {
    constexpr double rounding = 0.01, too_wide = 1e-3, least_filled = 0.4;
    const bool fits = 2.0 * margin + beside() + shapes_width() <= content.page_width + rounding &&
                      (!key_below || key_row_width() + 2.0 * margin <= content.page_width);
    // A key that is higher than the shapes leaves the page empty beside it.
    const double rows_filled =
        static_cast<double>(content.half_extents.size()) / static_cast<double>(n_rows * columns());
    const double share = key_below ? 1.0 : std::min(1.0, shapes_height() / std::max(key_height(), 1.0));
    return scale * (least_filled + (1.0 - least_filled) * share) * rows_filled *
           std::pow(worth_a_row, 1.0 - static_cast<double>(n_rows)) * (fits ? 1.0 : too_wide);
  }
};

Arrangement best_arrangement(const ShapesContent& content) {
  constexpr std::size_t most_rows = 3;
  std::vector<Arrangement> all;
  for (const bool key_below : {false, true}) {
    for (std::size_t rows = 1; rows <= std::min(most_rows, content.half_extents.size()); ++rows) {
      all.emplace_back(content, rows, key_below);
    }
  }
  return *std::ranges::max_element(all, {}, &Arrangement::score);
}

/// Rounds down to whole pixels, on which images end.
double on_pixels(double length) { return std::floor(length * page_pixels) / page_pixels; }

void place_shapes(const ShapesContent& content, const Arrangement& best, const Box& room, ShapesLayout& layout) {
  const double spare = (room.width() - best.shapes_width()) / static_cast<double>(best.columns());
  double top = 0.5 * (room.top + room.bottom) + 0.5 * best.shapes_height();
  double left = room.left;
  for (std::size_t i = 0; i < content.half_extents.size(); ++i) {
    const std::size_t column = i % best.columns(), row = i / best.columns();
    if (column == 0 && i > 0) {
      top -= best.heights[row - 1] * best.scale + shape_label_height;
      left = room.left;
    }
    const double middle = left + 0.5 * (best.column_width(column) + spare);
    const double centre = top - 0.5 * best.heights[row] * best.scale;
    left += best.column_width(column) + spare;
    const double width = on_pixels(2.0 * content.half_extents[i][0] * best.scale);
    const double height = on_pixels(2.0 * content.half_extents[i][1] * best.scale);
    // Rounding may lower the image by up to a pixel: it is raised by one, and its height is one less.
    constexpr double pixel = 1.0 / page_pixels;
    Box cell;
    cell.left = on_pixels(middle - 0.5 * width);
    cell.right = cell.left + width;
    cell.bottom = on_pixels(centre - 0.5 * height) + pixel;
    cell.top = cell.bottom + height - pixel;
    layout.cells.push_back(cell);
    layout.labels.push_back({middle, top - best.heights[row] * best.scale - 0.5 * shape_label_height});
  }
}

void place_key(const ShapesContent& content, const Arrangement& best, const Box& room, ShapesLayout& layout) {
  double left = 0.5 * (layout.width - best.key_row_width()), top = room.top - 0.5 * (room.height() - best.key_height());
  for (const double height : content.key_heights) {
    if (best.key_below) {
      layout.key.push_back({left, margin, left + content.key_width, margin + height});
      left += content.key_width;
    } else {
      layout.key.push_back({margin, top - height, margin + content.key_width, top});
      top -= height;
    }
  }
}

}  // namespace

ShapesLayout layout_of(const ShapesContent& content) {
  const Arrangement best = best_arrangement(content);
  const double height = std::max({best.shapes_height(), content.bar_width > 0.0 ? least_bar_height : 0.0,
                                  best.key_below ? 0.0 : best.key_height()});
  const double width = std::max(best.shapes_width(), best.key_below ? best.key_row_width() - best.bar() : 0.0);
  ShapesLayout layout;
  layout.scale = best.scale;
  layout.width = std::ceil(2.0 * margin + best.key_column() + width + best.bar());
  layout.height = std::ceil(2.0 * margin + height + best.key_row());
  const Box room{margin + best.key_column(), margin + best.key_row(), layout.width - margin - best.bar(),
                 layout.height - margin};
  place_shapes(content, best, room, layout);
  place_key(content, best, room, layout);
  if (content.bar_width > 0.0) {
    const double half_height = 0.5 * std::min(room.height(), highest_bar), middle = 0.5 * (room.bottom + room.top);
    const double right = layout.width - margin;
    layout.bar = {right - content.bar_width, middle - half_height, right, middle + half_height};
  }
  return layout;
}

}  // namespace vehd
