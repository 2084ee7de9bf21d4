#include "bie/pictures/sweep_means.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/page.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/pictures/sweep_frame.hpp"
#include "bie/pictures/sweep_map.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr std::array line_colours = {"#1f5fa8", "#d62728", "#2a8a3a", "#8a4fb0", "#c47a11", "#4a4a4a"};

std::vector<std::size_t> other_keys(const SweepRows& rows, std::size_t seed) {
  std::vector<std::size_t> others;
  for (std::size_t key = 0; key < rows.keys.size(); ++key) {
    if (key != seed) others.push_back(key);
  }
  return others;
}

/// Mean and standard error of the mean.
void average(const std::vector<double>& numbers, SweepMean& mean) {
  mean.n_runs = static_cast<int>(numbers.size());
  const double n = static_cast<double>(numbers.size());
  mean.mean = mean.error = std::numeric_limits<double>::quiet_NaN();
  if (numbers.empty()) return;
  double sum = 0.0, squares = 0.0;
  for (const double number : numbers) sum += number;
  mean.mean = sum / n;
  for (const double number : numbers) squares += (number - mean.mean) * (number - mean.mean);
  if (numbers.size() > 1) mean.error = std::sqrt(squares / (n - 1.0) / n);
}

/// Distinct values of the second key; one empty value without it.
std::vector<std::string> series_of(const std::vector<SweepMean>& means) {
  std::vector<std::string> series;
  for (const SweepMean& mean : means) {
    const std::string value = mean.values.size() > 1 ? mean.values[1] : "";
    if (std::ranges::find(series, value) == series.end()) series.push_back(value);
  }
  return series;
}

/// Ends of the bars, NaN without a mean.
std::vector<double> ends_of(const std::vector<SweepMean>& means, double sign) {
  std::vector<double> ends;
  for (const SweepMean& mean : means) ends.push_back(mean.mean + (mean.n_runs > 1 ? sign * mean.error : 0.0));
  return ends;
}

void draw_panel(Page& page, const SweepRows& rows, const std::vector<std::size_t>& keys, const std::string& header,
                const std::vector<SweepMean>& means, const Box& box) {
  std::vector<std::string> values;
  std::vector<double> numbers = ends_of(means, -1.0);
  for (const SweepMean& mean : means) values.push_back(mean.values.front());
  for (const double sign : {0.0, 1.0}) {
    const std::vector<double> ends = ends_of(means, sign);
    numbers.insert(numbers.end(), ends.begin(), ends.end());
  }
  const SweepRows::Key& key = rows.keys[keys.front()];
  const SweepAxis x = axis_of_values(key.name, values, key.is_logarithmic);
  const SweepAxis y = axis_of_numbers(column_label(header), numbers);
  draw_sweep_frame(page, box, x, y, true);
  const std::vector<std::string> series = series_of(means);
  const std::size_t n = means.size();
  for (std::size_t s = 0; s < series.size(); ++s) {
    const char* colour = line_colours[s % line_colours.size()];
    PageLine line{{}, 1.3, colour, false};
    for (std::size_t i = 0; i < n; ++i) {
      if (means[i].n_runs == 0 || (means[i].values.size() > 1 && means[i].values[1] != series[s])) continue;
      const auto at = [&](std::size_t place) { return box.at(x.places[i], y.places[place]); };
      line.points.push_back(at(n + i));
      page.areas.push_back(sweep_dot(at(n + i), colour));
      page.lines.push_back({{at(i), at(2 * n + i)}, 1.0, colour, false});
    }
    std::ranges::sort(line.points);
    if (line.points.size() > 1) page.lines.push_back(std::move(line));
    if (keys.size() < 2) continue;
    const double below = box.top - 9.0 - 10.0 * static_cast<double>(s);
    const std::string& name = rows.keys[keys[1]].name;
    page.texts.push_back({fmt::format("{} = {}", key_label(name), gnuplot_literal(series[s])),
                          {box.left + 6.0, below},
                          7.0,
                          TextAnchor::left,
                          colour});
  }
}

void write_means(const std::filesystem::path& file, const SweepRows& rows, const std::vector<std::size_t>& keys,
                 const std::vector<std::string>& headers, const std::vector<std::vector<SweepMean>>& means) {
  std::vector<std::string> names;
  for (const std::size_t key : keys) names.push_back(rows.keys[key].name);
  for (const std::string& header : headers) {
    names.push_back(header);
    names.push_back("standard error");
  }
  names.emplace_back("runs");
  std::string text = csv_line(names);
  for (std::size_t i = 0; i < means.front().size(); ++i) {
    std::vector<std::string> cells = means.front()[i].values;
    for (const std::vector<SweepMean>& column : means) {
      cells.push_back(fmt::format("{:.6g}", column[i].mean));
      cells.push_back(fmt::format("{:.2g}", column[i].error));
    }
    cells.push_back(std::to_string(means.front()[i].n_runs));
    text += csv_line(cells);
  }
  replace_file(file, text);
}

}  // namespace

std::optional<std::size_t> seed_key(const SweepRows& rows) {
  const auto is_seed = [](const SweepRows::Key& key) { return key.name.ends_with(".seed"); };
  const auto found = std::ranges::find_if(rows.keys, is_seed);
  if (found == rows.keys.end()) return std::nullopt;
  return static_cast<std::size_t>(found - rows.keys.begin());
}

std::vector<SweepMean> means_over_seeds(const SweepRows& rows, std::size_t seed, std::size_t column) {
  std::vector<SweepMean> means;
  std::vector<std::vector<double>> numbers;
  for (std::size_t row = 0; row < rows.n_rows(); ++row) {
    std::vector<std::string> values;
    for (const std::size_t key : other_keys(rows, seed)) values.push_back(rows.cells[row][key]);
    auto found = std::ranges::find(means, values, &SweepMean::values);
    if (found == means.end()) {
      means.push_back({values});
      numbers.emplace_back();
      found = means.end() - 1;
    }
    const double number = rows.number(row, column);
    if (rows.is_completed(row) && std::isfinite(number)) {
      numbers[static_cast<std::size_t>(found - means.begin())].push_back(number);
    }
  }
  for (std::size_t i = 0; i < means.size(); ++i) average(numbers[i], means[i]);
  return means;
}

std::vector<std::filesystem::path> draw_sweep_means(const SweepRows& rows, std::size_t seed,
                                                    const std::vector<std::size_t>& columns,
                                                    const PictureFile& picture) {
  const std::vector<std::size_t> keys = other_keys(rows, seed);
  if (keys.empty() || keys.size() > 2) {
    throw InputError(fmt::format("{}: has {} keys beside {}; means over it are drawn against one or two",
                                 picture.path.string(), keys.size(), rows.keys[seed].name));
  }
  std::vector<std::vector<SweepMean>> means;
  std::vector<std::string> headers;
  SweepPanels panels(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    headers.push_back(rows.columns[columns[i]]);
    means.push_back(means_over_seeds(rows, seed, columns[i]));
    draw_panel(panels.page, rows, keys, headers.back(), means.back(), panels.box(i));
  }
  draw_page(panels.page, picture);
  std::filesystem::path table = picture.path;
  table.replace_extension(".csv");
  write_means(table, rows, keys, headers, means);
  return {picture.path, table};
}

}  // namespace vehd
