#pragma once

#include <string>
#include <vector>

#include "bie/bench/picture.hpp"
#include "bie/support/csv.hpp"

namespace vehd {

/// A table that a bench has written as CSV, read back to draw pictures from it at any time.
class BenchRecord : public CsvTable {
 public:
  using CsvTable::CsvTable;

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
};

/// Panels of the picture for a table of a bench; empty if there is nothing to draw.
/// @param bench  name of the table's file, see name_of_table
/// @throws InputError if the record lacks a column
std::vector<BenchPanel> panels_of(const std::string& bench, const BenchRecord& record);

}  // namespace vehd
