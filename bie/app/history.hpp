#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "bie/stepping/evolution.hpp"

namespace vehd {

/// One row of history.csv: the state at `time` and the step that led to it.
struct HistoryRow {
  double time = 0.0;
  EvolutionStep step;
  Diagnostics diagnostics;
  int order = 0;            ///< p of the state
  double truncation = 0.0;  ///< see Evolution::truncation
};

/// Appends rows to history.csv; each is in the file when `append` returns.
class HistoryFile {
 public:
  /// Starts a file, or continues one after its first `kept_bytes` bytes when that is not 0.
  /// @throws InputError if the existing file is shorter than that or has other columns; OutputError
  HistoryFile(const std::filesystem::path& path, std::int64_t kept_bytes);

  void append(const HistoryRow& row);
  [[nodiscard]] std::int64_t bytes() const { return bytes_; }

 private:
  void write(const std::string& text);

  std::filesystem::path path_;
  std::ofstream stream_;
  std::int64_t bytes_ = 0;
};

/// A history.csv in memory.
class HistoryTable {
 public:
  /// @throws InputError "file:line: ..."
  explicit HistoryTable(const std::filesystem::path& path);

  [[nodiscard]] std::size_t n_rows() const { return n_rows_; }
  /// @throws InputError if there is no such column
  [[nodiscard]] const std::vector<double>& column(const std::string& name) const;

 private:
  std::string file_;
  std::vector<std::string> names_;
  std::vector<std::vector<double>> columns_;
  std::size_t n_rows_ = 0;
};

}  // namespace vehd
