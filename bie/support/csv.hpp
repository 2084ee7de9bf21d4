#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

/// Lines of CSV files: cells between commas, quoted where they must be (RFC 4180).
namespace vehd {

/// One line, newline included.
std::string csv_line(const std::vector<std::string>& cells);

/// Cells of a line, with the quoting undone and without carriage returns.
std::vector<std::string> csv_cells(const std::string& line);

/// Number at the beginning of a cell, NaN if there is none.
double number_of_cell(const std::string& cell);

/// Name and unit of a header "time [ms]"; the unit is empty if there is none.
std::pair<std::string, std::string> header_parts(const std::string& header);

/// A CSV file whose header names each column and its unit, "time [ms]". Blanks around cells, empty lines and lines that
/// begin with # are skipped, and so is a byte order mark.
class CsvTable {
 public:
  /// @throws InputError "file:line: ..." if it cannot be read or a row has more or fewer cells than the header
  explicit CsvTable(const std::filesystem::path& file);

  [[nodiscard]] std::size_t n_rows() const { return rows_.size(); }
  /// Names of the columns, without their units.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Unit of a column as written; empty if it has none.
  [[nodiscard]] const std::string& unit(std::size_t column) const { return units_[column]; }
  /// Index of the column of that name; nullopt if there is none.
  /// @throws InputError if there are two
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
  /// A cell as it is written, without blanks around it.
  [[nodiscard]] const std::string& text(std::size_t row, std::size_t column) const { return rows_[row].cells[column]; }
  /// A cell as a number in the unit of its column.
  /// @throws InputError if the cell holds no finite number
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// "file:line" of a row.
  [[nodiscard]] std::string place(std::size_t row) const;
  /// "file:line" of the header.
  [[nodiscard]] std::string header_place() const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };

  std::string file_;
  int header_line_ = 0;
  std::vector<std::string> names_, units_;
  std::vector<Row> rows_;
};

}  // namespace vehd
