#include "bie/support/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <string_view>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::string quoted_where_needed(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char letter : text) quoted.append(letter == '"' ? 2 : 1, letter);
  return quoted + '"';
}

std::string trimmed(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t\r");
  return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(" \t\r") - start + 1);
}

}  // namespace

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ',';
    line += quoted_where_needed(cells[i]);
  }
  return line + '\n';
}

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[i++];
    } else if (line[i] == '"') {
      quoted = !quoted;
    } else if (line[i] == ',' && !quoted) {
      cells.emplace_back();
    } else if (line[i] != '\r') {
      cells.back() += line[i];
    }
  }
  return cells;
}

double number_of_cell(const std::string& cell) {
  double number = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(cell.data(), cell.data() + cell.size(), number);
  return number;
}

std::pair<std::string, std::string> header_parts(const std::string& header) {
  const std::size_t at = header.find(" [");
  if (at == std::string::npos || !header.ends_with(']')) return {header, ""};
  return {header.substr(0, at), header.substr(at + 2, header.size() - at - 3)};
}

CsvTable::CsvTable(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: no such file, or it cannot be read", file_));
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF"; number == 1 && line.starts_with(byte_order_mark)) {
      line.erase(0, byte_order_mark.size());
    }
    const std::string content = trimmed(line);
    if (content.empty() || content.front() == '#') continue;
    std::vector<std::string> cells = csv_cells(content);
    std::ranges::transform(cells, cells.begin(), trimmed);
    if (header_line_ == 0) {
      header_line_ = number;
      if (cells.size() == 1 && content.find(';') != std::string::npos) {
        throw InputError(fmt::format("{}: has cells between semicolons; accepted: commas", header_place()));
      }
      for (const std::string& cell : cells) {
        auto [name, unit] = header_parts(cell);
        names_.push_back(std::move(name));
        units_.push_back(std::move(unit));
      }
      continue;
    }
    if (cells.size() != names_.size()) {
      throw InputError(fmt::format("{}:{}: has {} cells; accepted: {}, as many as the header has", file_, number,
                                   cells.size(), names_.size()));
    }
    rows_.push_back({number, std::move(cells)});
  }
}

std::optional<std::size_t> CsvTable::find(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return std::nullopt;
  const auto column = found - names_.begin();
  if (const auto other = std::find(found + 1, names_.end(), name); other != names_.end()) {
    throw InputError(fmt::format("{}: columns {} and {} are \"{}\"; accepted: one of them", header_place(), column + 1,
                                 other - names_.begin() + 1, shortened(name)));
  }
  return static_cast<std::size_t>(column);
}

double CsvTable::number(std::size_t row, std::size_t column) const {
  const std::string& cell = text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    throw InputError(
        fmt::format("{}: \"{}\" is \"{}\"; accepted: a finite number", place(row), names_[column], shortened(cell)));
  }
  return value;
}

std::string CsvTable::place(std::size_t row) const { return fmt::format("{}:{}", file_, rows_[row].line); }

std::string CsvTable::header_place() const { return fmt::format("{}:{}", file_, header_line_); }

}  // namespace vehd
