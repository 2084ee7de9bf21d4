#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/bench/picture.hpp"

namespace vehd {

/// A table that a bench has written as CSV, read back to draw pictures from it at any time.
class BenchRecord {
 public:
  /// @throws InputError if there is no such file, or if a row has another number of cells than the first line
  explicit BenchRecord(const std::filesystem::path& csv);

  /// Names of the columns in order.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] bool has(const std::string& column) const;
  /// Cells of a column in the rows whose column `key` contains `value`; in all rows without a key.
  [[nodiscard]] std::vector<std::string> texts(const std::string& column, const std::string& key = "",
                                               const std::string& value = "") const;
  /// The same cells as numbers, NaN if a cell is empty.
  [[nodiscard]] std::vector<double> numbers(const std::string& column, const std::string& key = "",
                                            const std::string& value = "") const;
  /// Distinct cells of a column, in the order of their first occurrence.
  [[nodiscard]] std::vector<std::string> different(const std::string& column) const;

 private:
  [[nodiscard]] std::size_t index(const std::string& column) const;

  std::string file_;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Panels of the picture for a table of a bench; empty if there is nothing to draw.
/// @param bench  name of the table's file, see name_of_table
/// @throws InputError if the record lacks a column
std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record);

}  // namespace vehd
