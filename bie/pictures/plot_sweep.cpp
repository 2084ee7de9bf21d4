#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "bie/pictures/page.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/pictures/sweep_frame.hpp"
#include "bie/pictures/sweep_map.hpp"
#include "bie/pictures/sweep_means.hpp"
#include "bie/scene/nearest_name.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr const char *line_colour = "#1f5fa8", *stopped_colour = "#9a9a9a";

std::vector<std::string> plain_names(const SweepRows& rows) {
  std::vector<std::string> names;
  for (const std::string& header : rows.columns) names.push_back(header_parts(header).first);
  return names;
}

std::vector<std::size_t> wanted_columns(const SweepPlotTask& task, const SweepRows& rows) {
  const std::vector<std::string> names = plain_names(rows);
  std::vector<std::size_t> wanted;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (task.columns.empty() && names[i] != "time") wanted.push_back(i);
  }
  for (const std::string& column : task.columns) {
    const auto found = std::ranges::find(names, column);
    if (found == names.end()) {
      throw InputError(fmt::format("--column {}: {} has no such column; {}", column, task.paths.table().string(),
                                   suggestion(column, {names.begin(), names.end()})));
    }
    wanted.push_back(static_cast<std::size_t>(found - names.begin()));
  }
  if (wanted.empty()) throw InputError(fmt::format("{}: has no column to draw", task.paths.table().string()));
  return wanted;
}

/// The usual border of a column, if its values lie on both sides.
std::optional<double> border_among(const std::vector<double>& numbers, const std::string& header) {
  const auto [least, most] = finite_range(numbers);
  const auto border = usual_border(header, least, most);
  return border && least < *border && *border < most ? border : std::nullopt;
}

void draw_line_panel(Page& page, const SweepRows& rows, std::size_t column, const SweepAxis& x, const Box& box,
                     std::optional<double> border) {
  const std::string& header = rows.columns[column];
  std::vector<double> numbers = rows.numbers(column);
  if (!border) border = border_among(numbers, header);
  // Extends the axis to the border, whose place it gives.
  if (border) numbers.push_back(*border);
  const SweepAxis y = axis_of_numbers(column_label(header), numbers);
  draw_sweep_frame(page, box, x, y, true);
  if (border) {
    const double height = box.bottom + y.places.back() * box.height();
    page.lines.push_back({{{box.left, height}, {box.right, height}}, 1.0, "#000000", false});
  }
  PageLine line{{}, 1.3, line_colour, false};
  const auto end_line = [&] {
    if (line.points.size() > 1) page.lines.push_back(line);
    line.points.clear();
  };
  // In the order of the key, whatever the order of the rows.
  std::vector<std::size_t> order(rows.n_rows());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return x.places[i]; });
  for (const std::size_t row : order) {
    if (!std::isfinite(y.places[row])) {
      end_line();
      continue;
    }
    const PagePoint at = box.at(x.places[row], y.places[row]);
    line.points.push_back(at);
    page.areas.push_back(sweep_dot(at, rows.is_completed(row) ? line_colour : stopped_colour));
  }
  end_line();
}

void draw_sweep_lines(const SweepPlotTask& task, const SweepRows& rows, const std::vector<std::size_t>& columns,
                      const PictureFile& picture) {
  std::vector<std::string> values;
  for (std::size_t row = 0; row < rows.n_rows(); ++row) values.push_back(rows.cells[row][0]);
  const SweepRows::Key& key = rows.keys.front();
  const SweepAxis x = axis_of_values(key.name, values, key.is_logarithmic);
  SweepPanels panels(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    draw_line_panel(panels.page, rows, columns[i], x, panels.box(i), task.border);
  }
  draw_page(panels.page, picture);
}

}  // namespace

std::vector<std::filesystem::path> plot_sweep(const SweepPlotTask& task) {
  const SweepRows rows(task.paths);
  const std::vector<std::size_t> columns = wanted_columns(task, rows);
  make_directory(task.output);
  const auto file = [&](const std::string& stem) {
    return PictureFile{task.output / fmt::format("{}.{}", stem, name_of(task.format)), task.format};
  };
  std::vector<std::filesystem::path> pictures;
  const std::optional<std::size_t> seed = seed_key(rows);
  const bool has_means = seed && rows.keys.size() > 1;
  if (rows.keys.size() == 1 || !rows.is_grid || has_means) {
    if (!task.curves.empty()) {
      throw InputError(fmt::format("--curve {}: {} is of one key, curves are drawn over maps of two",
                                   task.curves.string(), task.paths.table().string()));
    }
    if (has_means) return draw_sweep_means(rows, *seed, columns, file("lines"));
    draw_sweep_lines(task, rows, columns, file("lines"));
    return {file("lines").path};
  }
  if (rows.keys.size() > 2) {
    throw InputError(fmt::format("{}: has {} keys; pictures are drawn of one or two, other programs read the table",
                                 task.paths.table().string(), rows.keys.size()));
  }
  std::vector<SweepCurve> curves;
  if (!task.curves.empty()) curves = read_sweep_curves(task.curves, rows);
  for (const std::size_t column : columns) {
    const PictureFile picture = file("map_" + plain_names(rows)[column]);
    draw_sweep_map(rows, column, task.border, curves, picture);
    pictures.push_back(picture.path);
  }
  return pictures;
}

}  // namespace vehd
