#include "bie/runs/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string_view>
#include <utility>

#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

/// Last column of the file: the checksum of everything before it.
constexpr std::string_view checksum_column = "checksum";

std::string header_of(std::string_view name, const std::string& unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

std::string header_line(const OutputUnits& units, HistoryKind kind) {
  std::vector<std::string> cells;
  for (const HistoryColumn& column : history_columns(kind)) {
    cells.push_back(header_of(column.name, units.of(column.dimension).symbol));
  }
  cells.emplace_back(checksum_column);
  return csv_line(cells);
}

/// Headers of the columns of a file, without that of checksums.
struct FileHeader {
  std::vector<std::string> cells;
  bool is_sealed = false;

  explicit FileHeader(const std::string& line) : cells(csv_cells(line)), is_sealed(cells.back() == checksum_column) {
    if (is_sealed) cells.pop_back();
  }
};

Checksum checksum_of(std::istream& stream, std::int64_t bytes) {
  Checksum checksum;
  std::string block(std::size_t{1} << 16, '\0');
  while (bytes > 0 && stream.read(block.data(), std::min<std::int64_t>(bytes, std::ssize(block)))) {
    checksum.add(std::string_view(block.data(), static_cast<std::size_t>(stream.gcount())));
    bytes -= stream.gcount();
  }
  return checksum;
}

}  // namespace

void require_history(const std::filesystem::path& path, std::int64_t bytes, std::int64_t checksum) {
  if (bytes == 0) return;
  const HistoryTable table(path);
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path));
  if (size < bytes) {
    throw InputError(
        fmt::format("{}: rows are missing at its end: it has {} rows in {} bytes, and checkpoint.h5 counts {} bytes",
                    path.string(), table.n_rows(), size, bytes));
  }
  std::ifstream file(path, std::ios::binary);
  if (checksum_of(file, bytes).value() != checksum) {
    throw InputError(fmt::format("{}: was altered: its first {} bytes do not match the checksum in checkpoint.h5",
                                 path.string(), bytes));
  }
}

void require_columns(const std::filesystem::path& path, HistoryKind kind) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  const FileHeader header(line);
  const auto name_in = [](const std::string& cell) { return header_parts(cell).first; };
  if (!header.is_sealed ||
      !std::ranges::equal(header.cells, history_columns(kind), {}, name_in, &HistoryColumn::name)) {
    throw InputError(fmt::format("{}:1: has other columns", path.string()));
  }
}

HistoryFile::HistoryFile(const std::filesystem::path& path, std::int64_t kept_bytes, std::int64_t checksum,
                         const OutputUnits& units, HistoryKind kind)
    : path_(path), kind_(kind), checksum_(checksum) {
  for (const HistoryColumn& column : history_columns(kind)) factors_.push_back(units.of(column.dimension).factor);
  if (kept_bytes == 0) {
    stream_.open(path, std::ios::binary | std::ios::trunc);
    write(header_line(units, kind));
    return;
  }
  std::error_code error;
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(kept_bytes), error);
  if (error) throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  stream_.open(path, std::ios::binary | std::ios::app);
  bytes_ = kept_bytes;
}

Vector values_of(const HistoryRow& row, HistoryKind kind) {
  const std::vector<HistoryColumn>& columns = history_columns(kind);
  Vector values(std::ssize(columns));
  for (Index i = 0; i < values.size(); ++i) values[i] = columns[static_cast<std::size_t>(i)].value(row);
  return values;
}

void HistoryFile::append(const HistoryRow& row) { append(values_of(row, kind_)); }

void HistoryFile::append(const Vector& values) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    cells.push_back(fmt::format("{:.17g}", values[static_cast<Index>(i)] * factors_[i]));
  }
  const std::string row = fmt::format("{},", fmt::join(cells, ","));
  Checksum checksum = checksum_;
  checksum.add(row);
  write(fmt::format("{}{}\n", row, checksum.value()));
}

void HistoryFile::write(const std::string& text) {
  stream_ << text << std::flush;
  if (!stream_) {
    const std::string problem = write_problem(path_);
    // Closing tries again to write the rest: truncate the file after it.
    stream_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(bytes_), ignored);
    throw OutputError(problem);
  }
  bytes_ += static_cast<std::int64_t>(text.size());
  checksum_.add(text);
}

HistoryTable::HistoryTable(const std::filesystem::path& path) {
  std::ifstream stream;
  std::error_code error;
  // A pipe would wait for its writer.
  if (std::filesystem::is_regular_file(path, error)) stream.open(path);
  *this = HistoryTable(stream, path.string());
}

HistoryTable::HistoryTable(std::istream& stream, std::string name) : file_(std::move(name)) {
  std::string line;
  if (!std::getline(stream, line)) throw InputError(fmt::format("{}: no such file or empty", file_));
  const FileHeader header(line);
  is_sealed_ = header.is_sealed;
  for (const std::string& cell : header.cells) {
    auto [plain, unit] = header_parts(cell);
    names_.push_back(std::move(plain));
    units_.push_back(std::move(unit));
  }
  columns_.resize(names_.size());
  Checksum before;
  before.add(line + "\n");
  while (std::getline(stream, line)) {
    if (is_sealed_) {
      // A last line without a newline is an incomplete row.
      if (stream.eof()) break;
      const std::size_t cell = line.rfind(',') + 1;
      before.add(line.substr(0, cell));
      if (cell == 0 || line.substr(cell) != std::to_string(before.value())) {
        throw InputError(fmt::format(
            "{}:{}: does not match its checksum: it was altered, or lines before it were altered or removed", file_,
            n_rows_ + 2));
      }
      before.add(line.substr(cell) + "\n");
      line.resize(cell - 1);
    }
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != names_.size()) {
      throw InputError(
          fmt::format("{}:{}: has {} columns; accepted: {}", file_, n_rows_ + 2, cells.size(), names_.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) columns_[i].push_back(std::strtod(cells[i].c_str(), nullptr));
    ++n_rows_;
  }
}

HistoryTable::HistoryTable(const OutputUnits& units, HistoryKind kind) : file_("history"), kind_(kind) {
  for (const HistoryColumn& column : history_columns(kind)) {
    const OutputUnit unit = units.of(column.dimension);
    names_.emplace_back(column.name);
    units_.push_back(unit.symbol);
    factors_.push_back(unit.factor);
  }
  columns_.resize(names_.size());
}

void HistoryTable::append(const HistoryRow& row) {
  const Vector values = values_of(row, kind_);
  for (std::size_t i = 0; i < factors_.size(); ++i) columns_[i].push_back(values[static_cast<Index>(i)] * factors_[i]);
  ++n_rows_;
}

std::int64_t HistoryTable::n_steps() const {
  const std::vector<double>& sizes = column("dt");
  return std::count_if(sizes.begin(), sizes.end(), [](double dt) { return dt > 0.0; });
}

double HistoryTable::largest_magnitude(const std::string& name) const {
  double largest = 0.0;
  for (const double value : column(name)) {
    if (std::isnan(value)) return value;
    largest = std::max(largest, std::abs(value));
  }
  return largest;
}

std::size_t HistoryTable::index(const std::string& name) const {
  const auto found = std::ranges::find(names_, name);
  if (found == names_.end()) throw InputError(fmt::format("{}:1: has no column {}", file_, name));
  return static_cast<std::size_t>(found - names_.begin());
}

bool HistoryTable::has(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }

const std::vector<double>& HistoryTable::column(const std::string& name) const { return columns_[index(name)]; }

const std::string& HistoryTable::unit(const std::string& name) const { return units_[index(name)]; }

std::string HistoryTable::header(const std::string& name) const { return header_of(name, unit(name)); }

std::string HistoryTable::time_text(double time) const {
  const std::string& symbol = unit("time");
  return symbol.empty() ? fmt::format("{:g}", time) : fmt::format("{:g} {}", time, symbol);
}

std::map<std::string, std::string, std::less<>> HistoryTable::symbols() const {
  std::map<std::string, std::string, std::less<>> symbols;
  const auto add = [&](const HistoryColumn& column) {
    const auto found = std::ranges::find(names_, column.name);
    if (found == names_.end()) return;
    const std::string& symbol = units_[static_cast<std::size_t>(found - names_.begin())];
    if (!symbol.empty()) symbols.emplace(column.dimension, symbol);
  };
  std::ranges::for_each(history_columns(), add);
  for (std::size_t model = 0; model < n_poration_models; ++model) {
    std::ranges::for_each(poration_columns(static_cast<PorationModel>(model)), add);
  }
  return symbols;
}

}  // namespace vehd
