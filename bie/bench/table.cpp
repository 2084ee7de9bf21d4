#include "bie/bench/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bie/support/csv.hpp"
#include "bie/support/text_table.hpp"

namespace vehd {

Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const double median = 0.5 * (values[(values.size() - 1) / 2] + values[values.size() / 2]);
  return {median, values.front(), values.back(), static_cast<std::int64_t>(values.size())};
}

bool wants_repeat(const std::vector<double>& seconds, int repeats) {
  constexpr double kEnough = 4.0;
  return static_cast<int>(seconds.size()) < repeats && std::accumulate(seconds.begin(), seconds.end(), 0.0) < kEnough;
}

double fitted_exponent(const std::vector<double>& x, const std::vector<double>& y) {
  const double n = static_cast<double>(x.size());
  double mean_x = 0.0, mean_y = 0.0, xx = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += std::log(x[i]) / n;
    mean_y += std::log(y[i]) / n;
  }
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (std::log(x[i]) - mean_x) * (std::log(x[i]) - mean_x);
    xy += (std::log(x[i]) - mean_x) * (std::log(y[i]) - mean_y);
  }
  return xy / xx;
}

namespace {

struct Entry {
  std::string key;
  nlohmann::ordered_json value;
};

nlohmann::ordered_json number(double value) {
  if (std::isfinite(value)) return value;
  return nullptr;
}

/// Entries of a cell, one for each key of its column.
std::vector<Entry> entries_of(const BenchColumn& column, const BenchCell& cell) {
  if (column.timing) {
    const std::array keys{column.key, column.key + "_min", column.key + "_max", column.key + "_repeats"};
    const auto* spread = std::get_if<Spread>(&cell);
    if (spread == nullptr) return {{keys[0], nullptr}, {keys[1], nullptr}, {keys[2], nullptr}, {keys[3], nullptr}};
    return {{keys[0], number(spread->median)},
            {keys[1], number(spread->min)},
            {keys[2], number(spread->max)},
            {keys[3], spread->repeats}};
  }
  if (const auto* text = std::get_if<std::string>(&cell)) return {{column.key, *text}};
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return {{column.key, *count}};
  if (const auto* value = std::get_if<double>(&cell)) return {{column.key, number(*value)}};
  return {{column.key, nullptr}};
}

std::vector<Entry> entries_of(const BenchTable& table, const std::vector<BenchCell>& row) {
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < row.size(); ++i) {
    for (Entry& entry : entries_of(table.columns[i], row[i])) entries.push_back(std::move(entry));
  }
  return entries;
}

std::string csv_text(const nlohmann::ordered_json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return fmt::format("{:.6g}", value.get<double>());
  return value.dump();
}

std::string shown(const BenchColumn& column, const BenchCell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  const auto* spread = std::get_if<Spread>(&cell);
  const auto* value = spread != nullptr ? &spread->median : std::get_if<double>(&cell);
  return value != nullptr && std::isfinite(*value) ? fmt::format(fmt::runtime(column.format), *value) : "–";
}

std::string padded(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, display_width(text)), ' ') + text;
}

std::size_t column_width(const BenchColumn& column) { return std::max(column.width, display_width(column.heading)); }

template <typename Text>
std::string line(const BenchTable& table, const char* before, const char* between, const char* after,
                 const Text& text) {
  std::string result = before;
  bool first = true;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    if (table.columns[i].heading.empty()) continue;
    if (!first) result += between;
    first = false;
    result += text(i);
  }
  return result + after;
}

}  // namespace

const BenchCell& cell_of(const BenchTable& table, std::size_t row, const std::string& key) {
  const auto column = std::ranges::find(table.columns, key, &BenchColumn::key);
  return table.rows[row][static_cast<std::size_t>(column - table.columns.begin())];
}

std::string csv_of(const BenchTable& table) {
  std::string text;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    std::vector<std::string> keys, values;
    for (const Entry& entry : entries_of(table, table.rows[i])) {
      keys.push_back(entry.key);
      values.push_back(csv_text(entry.value));
    }
    if (i == 0) text += csv_line(keys);
    text += csv_line(values);
  }
  return text;
}

nlohmann::ordered_json json_of(const BenchTable& table) {
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  for (const auto& row : table.rows) {
    nlohmann::ordered_json object;
    for (Entry& entry : entries_of(table, row)) object[entry.key] = std::move(entry.value);
    rows.push_back(std::move(object));
  }
  return rows;
}

std::string markdown_of(const BenchTable& table) {
  std::string text = line(table, "| ", " | ", " |\n", [&](std::size_t i) { return table.columns[i].heading; });
  text += line(table, "| ", " | ", " |\n", [](std::size_t) { return std::string("---"); });
  for (const auto& row : table.rows) {
    text += line(table, "| ", " | ", " |\n", [&](std::size_t i) { return shown(table.columns[i], row[i]); });
  }
  return text;
}

std::string heading_line(const BenchTable& table) {
  return line(table, "", "  ", "\n",
              [&](std::size_t i) { return padded(table.columns[i].heading, column_width(table.columns[i])); });
}

std::string row_line(const BenchTable& table, const std::vector<BenchCell>& row) {
  return line(table, "", "  ", "\n",
              [&](std::size_t i) { return padded(shown(table.columns[i], row[i]), column_width(table.columns[i])); });
}

}  // namespace vehd
