#include "bie/fit/data_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>

#include "bie/scene/nearest_name.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"

namespace vehd {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t start = text.find_first_not_of(" \t");
  return start == std::string::npos ? "" : text.substr(start, text.find_last_not_of(" \t") - start + 1);
}

std::vector<std::string> trimmed_cells(const std::string& line) {
  std::vector<std::string> cells = csv_cells(line);
  std::ranges::transform(cells, cells.begin(), trimmed);
  return cells;
}

}  // namespace

DataTable::DataTable(const std::filesystem::path& file) : file_(file.string()) {
  std::ifstream stream(file);
  if (!stream) throw InputError(fmt::format("{}: no such file, or it cannot be read", file_));
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    const std::string content = trimmed(line);
    if (content.empty() || content == "\r" || content.front() == '#') continue;
    std::vector<std::string> cells = trimmed_cells(content);
    if (header_line_ == 0) {
      header_line_ = number;
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
  if (rows_.empty()) throw InputError(fmt::format("{}: holds no numbers; accepted: a header and rows below it", file_));
}

std::optional<std::size_t> DataTable::find(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) return std::nullopt;
  return static_cast<std::size_t>(found - names_.begin());
}

std::size_t DataTable::column(const std::string& name) const {
  if (const auto found = find(name)) return *found;
  throw InputError(fmt::format("{}: has no column \"{}\"; {}", header_place(), name,
                               suggestion(name, {names_.begin(), names_.end()})));
}

double DataTable::number(std::size_t row, std::size_t column) const {
  const std::string& cell = text(row, column);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc() || end != cell.data() + cell.size() || !std::isfinite(value)) {
    throw InputError(
        fmt::format("{}: \"{}\" is \"{}\"; accepted: a finite number", place(row), names_[column], shortened(cell)));
  }
  return value;
}

std::string DataTable::place(std::size_t row) const { return fmt::format("{}:{}", file_, rows_[row].line); }

std::string DataTable::header_place() const { return fmt::format("{}:{}", file_, header_line_); }

}  // namespace vehd
