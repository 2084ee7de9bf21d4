#include "bie/bench/record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
BenchRecord::BenchRecord(const std::filesystem::path& csv) : file_(csv.string()) {
  if (!std::filesystem::exists(csv)) throw InputError(fmt::format("{}: no such file", file_));
  std::istringstream stream(text_of_file(csv));
  std::string line;
  if (std::getline(stream, line)) columns_ = quoted_csv_cells(line);
  while (std::getline(stream, line)) {
    rows_.push_back(quoted_csv_cells(line));
    if (rows_.back().size() != columns_.size()) {
      throw InputError(fmt::format("{}:{}: has {} cells; accepted: {}", file_, rows_.size() + 1, rows_.back().size(),
                                   columns_.size()));
    }
  }
}

bool BenchRecord::has(const std::string& column) const { return std::ranges::find(columns_, column) != columns_.end(); }

std::size_t BenchRecord::index(const std::string& column) const {
  const auto found = std::ranges::find(columns_, column);
  if (found == columns_.end()) throw InputError(fmt::format("{}:1: has no column {}", file_, column));
  return static_cast<std::size_t>(found - columns_.begin());
}

std::vector<std::string> BenchRecord::texts(const std::string& column, const std::string& key,
                                            const std::string& value) const {
  const std::size_t at = index(column);
  std::vector<std::string> result;
  for (const auto& row : rows_) {
    if (key.empty() || row[index(key)] == value) result.push_back(row[at]);
  }
  return result;
}

std::vector<double> BenchRecord::numbers(const std::string& column, const std::string& key,
                                         const std::string& value) const {
  std::vector<double> result;
  for (const std::string& text : texts(column, key, value)) {
    double number = std::numeric_limits<double>::quiet_NaN();
    std::from_chars(text.data(), text.data() + text.size(), number);
    result.push_back(number);
  }
  return result;
}

std::vector<std::string> BenchRecord::different(const std::string& column) const {
  std::vector<std::string> result;
  for (const std::string& text : texts(column)) {
    if (std::ranges::find(result, text) == result.end()) result.push_back(text);
  }
  return result;
}

}  // namespace vehd
