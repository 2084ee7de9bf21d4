#pragma once

#include <filesystem>
#include <string>
#include <vector>

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
  /// Whether the run of the row came to its end.
  [[nodiscard]] bool is_completed(std::size_t row) const;
};

/// Whether a directory is that of a sweep.
bool is_sweep(const std::filesystem::path& directory);

}  // namespace vehd
