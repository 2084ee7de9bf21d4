#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vehd {

/// Measured data in CSV: the header names each column and its unit, "time [ms]", as in files of vehd. Empty lines and
/// lines that begin with # are skipped.
class DataTable {
 public:
  /// @throws InputError "file:line: ..." if it cannot be read or a row has more or fewer cells than the header
  explicit DataTable(const std::filesystem::path& file);

  [[nodiscard]] std::size_t n_rows() const { return rows_.size(); }
  /// Name of a column, counted from 0, without its unit.
  [[nodiscard]] const std::string& name(std::size_t column) const { return names_[column]; }
  /// Unit of a column as written; empty if it has none.
  [[nodiscard]] const std::string& unit(std::size_t column) const { return units_[column]; }
  /// Index of the column of that name; nullopt if there is none.
  [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;
  /// Index of the column of that name.
  /// @throws InputError that names the nearest column
  [[nodiscard]] std::size_t column(const std::string& name) const;
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
