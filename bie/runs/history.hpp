#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bie/scene/output_units.hpp"
#include "bie/stepping/evolution.hpp"
#include "bie/support/checksum.hpp"

namespace vehd {

/// One row of history.csv: the state at `time` and the step that led to it. At a jump of the forcing there are two rows
/// of the same time: first the values just before it with that step, then those just after it with a dt of 0.
struct HistoryRow {
  double time = 0.0;
  StepAttempt step;
  Diagnostics diagnostics;
  int order = 0;            ///< p of the state; with several vesicles, the highest
  double truncation = 0.0;  ///< see Evolution::truncation
  // With several vesicles only.
  SmallestGap gap{};
  std::vector<int> orders{};  ///< p of each vesicle
  int vesicle = 0;            ///< number of the row's vesicle
};

/// Which vesicles a table of a run covers, and which optional columns it has.
struct HistoryKind {
  /// history.csv of one vesicle; with several vesicles, history.csv of all of them and vesicles.csv of each.
  enum Rows { of_one, of_all, of_each };

  HistoryKind(Rows of_whom = of_one) : rows(of_whom) {}  // NOLINT(google-explicit-constructor)

  Rows rows;
  std::optional<PorationModel> poration{};  ///< model whose columns it has
  bool varying = false;                     ///< has columns of a membrane that varies in space or pumps
  bool wall = false;                        ///< has columns of a wall
};

/// The kind of history.csv of a scene.
HistoryKind history_kind(const Scene& scene);
/// The same kind with a row for each vesicle.
HistoryKind of_each_like(HistoryKind kind);

/// Kind of a column's values.
enum class ColumnMeaning {
  quantity,
  method,  ///< how the run computes
  error    ///< itself an error
};

/// A column of history.csv. The header in the file is its name, followed by " [unit]" if the file has units.
struct HistoryColumn {
  std::string_view name;
  std::string_view dimension;  ///< see units.hpp; "1" if dimensionless
  double (*value)(const HistoryRow&);
  ColumnMeaning meaning = ColumnMeaning::quantity;
};

/// All columns in the order of the file.
const std::vector<HistoryColumn>& history_columns(HistoryKind kind = HistoryKind::of_one);
/// The columns of a membrane that porates; in the file they follow the rheology.
std::vector<HistoryColumn> poration_columns(PorationModel model);

/// Values of all columns of a row, [n_columns], in the numbers of the scene.
Vector values_of(const HistoryRow& row, HistoryKind kind);

/// Compares a table with the size and checksum in a checkpoint; with 0 bytes nothing is compared.
/// @throws InputError naming the row that was altered, or if rows are missing at the end
void require_history(const std::filesystem::path& path, std::int64_t bytes, std::int64_t checksum);

/// @throws InputError if a table has other columns than those of its kind
void require_columns(const std::filesystem::path& path, HistoryKind kind);

/// Appends rows to history.csv; each is in the file when `append` returns. Numbers have 17 significant digits: reading
/// them back gives the same bits. The last cell of a row is the checksum of everything in the file before it.
class HistoryFile {
 public:
  /// Starts a file, or continues one after its first `kept_bytes` bytes if that is not 0.
  /// @param checksum  checksum of these bytes, verified by `require_history`
  /// @param units  units of the file; if it is continued, those that it began with
  /// @throws OutputError
  HistoryFile(const std::filesystem::path& path, std::int64_t kept_bytes, std::int64_t checksum,
              const OutputUnits& units = {}, HistoryKind kind = HistoryKind::of_one);

  /// Appends a row. If the disk is full, no part of the row stays in the file.
  /// @throws OutputError if the disk is full
  void append(const HistoryRow& row);
  /// Appends the values of all columns, [n_columns], in the numbers of the scene.
  /// @throws OutputError if the disk is full
  void append(const Vector& values);
  /// Bytes in the file so far.
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }
  /// Checksum of these bytes.
  [[nodiscard]] std::int64_t checksum() const { return checksum_.value(); }

 private:
  void write(const std::string& text);

  std::filesystem::path path_;
  HistoryKind kind_;
  std::vector<double> factors_;  ///< unit factors of the columns
  std::ofstream stream_;
  std::int64_t bytes_ = 0;
  Checksum checksum_;
};

/// A history.csv in memory. Columns have their plain names, whatever the units of the file; the checksum column is left
/// out.
class HistoryTable {
 public:
  /// Reads a file and verifies the checksums of its rows. An incomplete last row, which a kill can leave, is ignored.
  /// @throws InputError "file:line: ..."
  explicit HistoryTable(const std::filesystem::path& path);
  /// Reads a table from any stream; `name` stands for the file in messages.
  /// @throws InputError "name:line: ..."
  HistoryTable(std::istream& stream, std::string name);
  /// An empty table without a file.
  HistoryTable(const OutputUnits& units, HistoryKind kind);

  /// Appends a row to a table without a file, with the bits that reading it from a file would give.
  void append(const HistoryRow& row);

  [[nodiscard]] std::size_t n_rows() const { return n_rows_; }
  /// Whether rows have checksums; without them damage goes unnoticed.
  [[nodiscard]] bool is_sealed() const { return is_sealed_; }
  /// Names of all columns, in order.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// Number of steps in the rows; the start and the second row at a jump are not steps.
  /// @throws InputError if there is no column of step sizes
  [[nodiscard]] std::int64_t n_steps() const;
  /// Largest magnitude in a column: 0 if it is empty, NaN if it has one. @throws InputError as `column`
  [[nodiscard]] double largest_magnitude(const std::string& name) const;
  /// Whether there is a column of this name.
  [[nodiscard]] bool has(const std::string& name) const;
  /// Values of a column in the unit of the file. @throws InputError if there is no such column
  [[nodiscard]] const std::vector<double>& column(const std::string& name) const;
  /// Symbol of the unit of a column; empty if it has none. @throws InputError as `column`
  [[nodiscard]] const std::string& unit(const std::string& name) const;
  /// Header of a column in the file. @throws InputError as `column`
  [[nodiscard]] std::string header(const std::string& name) const;
  /// Text of a time of the file, with its unit.
  [[nodiscard]] std::string time_text(double time) const;
  /// The units of the columns.
  /// @param scales  of the scene of the run
  [[nodiscard]] OutputUnits units(std::optional<UnitsScene> scales) const { return {std::move(scales), symbols()}; }
  /// Symbols of the units by dimension.
  [[nodiscard]] std::map<std::string, std::string, std::less<>> symbols() const;

 private:
  [[nodiscard]] std::size_t index(const std::string& name) const;

  std::string file_;
  HistoryKind kind_ = HistoryKind::of_one;
  std::vector<double> factors_;  ///< unit factors of a table without a file
  std::vector<std::string> names_, units_;
  std::vector<std::vector<double>> columns_;
  std::size_t n_rows_ = 0;
  bool is_sealed_ = false;
};

}  // namespace vehd
