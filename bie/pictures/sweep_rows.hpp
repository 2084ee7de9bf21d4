#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/runs/sweep/sweep_table.hpp"

namespace vehd {

/// A table of a sweep, read back.
struct SweepRows {
  /// One of the keys that a sweep has varied.
  struct Key {
    std::string name;
    bool is_logarithmic = false;
  };

  std::vector<Key> keys;
  bool is_grid = true;
  std::vector<std::string> columns;             ///< headers of those that come from histories
  std::vector<std::vector<std::string>> cells;  ///< of each row: values of the keys, columns, and four more

  /// @throws InputError if the directory holds no table of a sweep, or a damaged one
  explicit SweepRows(const SweepPaths& paths);

  [[nodiscard]] std::size_t n_rows() const { return cells.size(); }
  /// Number of a column; NaN where the run has none.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// Of a column, in the order of the rows.
  [[nodiscard]] std::vector<double> numbers(std::size_t column) const;
  /// Whether the run of the row came to its end.
  [[nodiscard]] bool is_completed(std::size_t row) const;
};

/// Whether a directory is that of a sweep.
bool is_sweep(const std::filesystem::path& directory);

/// Points in a map of two keys, each 0 ... 1 of its width and height.
using SweepCurve = std::vector<PagePoint>;

/// Curves to be drawn over a map: known borders, or measurements. The file is CSV, its header names both
/// keys, in any order, and its values have the units of the table; an empty line begins another curve. Values of a map
/// stand in the middle of their cells, those between them by even steps, or by even factors where the sweep has them.
/// A curve ends where it leaves the map.
/// @throws InputError "file:line: what is wrong"; if a key has values that are no numbers of one unit
std::vector<SweepCurve> read_sweep_curves(const std::filesystem::path& path, const SweepRows& rows);

}  // namespace vehd
