#pragma once

#include <string>
#include <vector>

#include "bie/runs/sweep/sweep_table.hpp"

namespace vehd {

/// A table of a sweep, read back.
class SweepRows {
 public:
  /// One of the keys that a sweep has varied.
  struct Key {
    std::string name;
    bool is_logarithmic = false;
  };

  /// @throws InputError if the directory holds no table of a sweep, or a damaged one
  explicit SweepRows(const SweepPaths& paths);

  [[nodiscard]] const std::vector<Key>& keys() const { return keys_; }
  [[nodiscard]] bool is_grid() const { return is_grid_; }
  /// Headers of the columns that come from histories.
  [[nodiscard]] const std::vector<std::string>& columns() const { return columns_; }
  [[nodiscard]] std::size_t n_rows() const { return rows_.size(); }
  /// Value of a key in a row, as written.
  [[nodiscard]] const std::string& value(std::size_t row, std::size_t key) const { return rows_[row][key]; }
  /// Number of a column; NaN where the run has none.
  [[nodiscard]] double number(std::size_t row, std::size_t column) const;
  /// Whether the run of the row came to its end.
  [[nodiscard]] bool is_completed(std::size_t row) const;

 private:
  std::vector<Key> keys_;
  bool is_grid_ = true;
  std::vector<std::string> columns_;
  std::vector<std::vector<std::string>> rows_;
};

/// Whether a directory is that of a sweep.
bool is_sweep(const std::filesystem::path& directory);

}  // namespace vehd
