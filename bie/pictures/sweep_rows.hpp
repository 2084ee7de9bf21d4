#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/runs/sweep/sweep_table.hpp"

namespace vehd {

/// The table of a sweep, read from its files.
struct SweepRows {
  /// A key that the sweep varies.
  struct Key {
    std::string name;
    bool is_logarithmic = false;
  };

  std::vector<Key> keys;
  bool is_grid = true;
  std::vector<std::string> columns;             ///< headers of the columns taken from histories
  std::vector<std::vector<std::string>> cells;  ///< of each row: values of the keys, columns, and four more

  /// @throws InputError if the directory holds no table of a sweep, or a damaged one
  explicit SweepRows(const SweepPaths& paths);

  [[nodiscard]] std::size_t n_rows() const { return cells.size(); }
  /// Number in a column; NaN if the run has none.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// Numbers of a column, in the order of the rows.
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
  /// Did the run of the row come to its end?
  [[nodiscard]] bool is_completed(std::size_t row) const;
};

/// Is the directory that of a sweep?
bool is_sweep(const std::filesystem::path& directory);

/// A curve in a map of two keys: points as fractions 0 ... 1 of its width and height.
using SweepCurve = std::vector<PagePoint>;

/// Reads curves to be drawn over a map, such as known borders or measurements. The file is CSV: its header names both
/// keys, in any order; values have the units of the table; an empty line begins another curve. Values of the sweep are
/// in the middle of their cells, with linear interpolation between them, of the logarithm for a logarithmic key. A
/// curve ends where it leaves the map.
/// @throws InputError "file:line: problem", or if values of a key are not numbers of one unit
std::vector<SweepCurve> read_sweep_curves(const std::filesystem::path& path, const SweepRows& rows);

}  // namespace vehd
