#include "bie/pictures/shapes_layout.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vehd {
namespace {

constexpr double margin = 5.0, gap = 8.0;
/// Height of a page over its width, at most.
constexpr double tallest = 0.7;
constexpr double least_bar_height = 84.0;
/// A further row pays only if the shapes become larger by this factor.
constexpr double worth_a_row = 1.12;
constexpr double largest_cell = 190.0;

/// Cells end on whole pixels.
double on_pixels(double length) { return std::floor(length * pixels_per_point) / pixels_per_point; }

struct Arrangement {
  int rows = 1;
  bool key_below = false;
};

struct Sizes {
  int columns = 1;
  double key_column = 0.0, key_row = 0.0;
  double scale = 0.0, cell_width = 0.0, cell_height = 0.0;
  double column_width = 0.0;  ///< of a cell with its text
};

Sizes sizes_of(const ShapesContent& content, const Arrangement& arrangement) {
  Sizes sizes;
  const int n = static_cast<int>(content.n_shapes);
  sizes.columns = (n + arrangement.rows - 1) / arrangement.rows;
  if (!content.key_heights.empty()) {
    if (arrangement.key_below) {
      sizes.key_row = gap + *std::ranges::max_element(content.key_heights);
    } else {
      sizes.key_column = content.key_width + gap;
    }
  }
  const double bar = content.bar_width > 0.0 ? content.bar_width + gap : 0.0;
  const double across = (content.page_width - 2.0 * margin - sizes.key_column - bar) / sizes.columns - gap;
  const double down =
      (tallest * content.page_width - 2.0 * margin - sizes.key_row) / arrangement.rows - shape_label_height;
  sizes.scale = std::min({across / (2.0 * content.half_width), down / (2.0 * content.half_height),
                          largest_cell / (2.0 * std::max(content.half_width, content.half_height))});
  sizes.cell_width = on_pixels(2.0 * content.half_width * sizes.scale);
  sizes.cell_height = on_pixels(2.0 * content.half_height * sizes.scale);
  sizes.column_width = std::max(sizes.cell_width, content.label_width) + gap;
  return sizes;
}

double width_of_shapes(const Sizes& sizes) { return sizes.columns * sizes.column_width; }

}  // namespace

ShapesLayout layout_of(const ShapesContent& content) {
  Arrangement best;
  double best_score = 0.0;
  for (const bool key_below : {false, true}) {
    for (int rows = 1; rows <= std::min<int>(3, static_cast<int>(content.n_shapes)); ++rows) {
      const Sizes sizes = sizes_of(content, {rows, key_below});
      const double bar = content.bar_width > 0.0 ? content.bar_width + gap : 0.0;
      const double key_row = static_cast<double>(content.key_heights.size()) * content.key_width;
      const bool fits = 2.0 * margin + sizes.key_column + bar + width_of_shapes(sizes) <= content.page_width + 0.01 &&
                        (!key_below || key_row + 2.0 * margin <= content.page_width);
      // A key that is higher than the shapes leaves the page empty beside it.
      const double key_height = std::accumulate(content.key_heights.begin(), content.key_heights.end(), 0.0);
      const double shapes_height = rows * (sizes.cell_height + shape_label_height);
      const double filled = key_below ? 1.0 : std::min(1.0, 0.4 + 0.6 * shapes_height / std::max(key_height, 1.0));
      const double score = sizes.scale * filled * std::pow(worth_a_row, -(rows - 1)) * (fits ? 1.0 : 1e-3);
      if (score > best_score) {
        best_score = score;
        best = {rows, key_below};
      }
    }
  }
  const Sizes sizes = sizes_of(content, best);
  const double shapes_height = best.rows * (sizes.cell_height + shape_label_height);
  const double key_height = std::accumulate(content.key_heights.begin(), content.key_heights.end(), 0.0);
  const double key_row_width = static_cast<double>(content.key_heights.size()) * content.key_width;
  const double middle_height = std::max({shapes_height, content.bar_width > 0.0 ? least_bar_height : 0.0,
                                         best.key_below ? 0.0 : key_height});

  ShapesLayout layout;
  layout.scale = sizes.scale;
  const double bar = content.bar_width > 0.0 ? content.bar_width + gap : 0.0;
  const double shapes_width = std::max(width_of_shapes(sizes), best.key_below ? key_row_width - bar : 0.0);
  layout.width = std::ceil(2.0 * margin + sizes.key_column + shapes_width + bar);
  layout.height = std::ceil(2.0 * margin + middle_height + sizes.key_row);

  const double top = layout.height - margin, bottom = margin + sizes.key_row;
  const double left = margin + sizes.key_column;
  const double first_row = 0.5 * (top + bottom) + 0.5 * shapes_height;
  const double column_width = shapes_width / sizes.columns;
  for (std::size_t i = 0; i < content.n_shapes; ++i) {
    const auto row = static_cast<double>(i / static_cast<std::size_t>(sizes.columns));
    const auto column = static_cast<double>(i % static_cast<std::size_t>(sizes.columns));
    const double middle = left + (column + 0.5) * column_width;
    Box cell;
    cell.left = on_pixels(middle - 0.5 * sizes.cell_width);
    cell.right = cell.left + sizes.cell_width;
    cell.top = on_pixels(first_row - row * (sizes.cell_height + shape_label_height));
    cell.bottom = cell.top - sizes.cell_height;
    layout.cells.push_back(cell);
    layout.labels.push_back({middle, cell.bottom - 0.5 * shape_label_height});
  }
  double key_left = margin, key_top = top - 0.5 * (top - bottom - key_height);
  for (const double height : content.key_heights) {
    if (best.key_below) {
      layout.key.push_back({key_left, margin, key_left + content.key_width, margin + height});
      key_left += content.key_width;
    } else {
      layout.key.push_back({margin, key_top - height, margin + content.key_width, key_top});
      key_top -= height;
    }
  }
  if (content.bar_width > 0.0) {
    constexpr double highest_bar = 170.0;
    const double height = std::min(top - bottom, highest_bar), middle = 0.5 * (top + bottom);
    const double right = layout.width - margin;
    layout.bar = {right - content.bar_width, middle - 0.5 * height, right, middle + 0.5 * height};
  }
  return layout;
}

}  // namespace vehd
