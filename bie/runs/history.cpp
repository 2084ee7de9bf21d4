#include "bie/runs/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

struct DiagnosticColumn {
  std::string_view name;
  double VesicleDiagnostics::*member;
};

constexpr std::array diagnostic_columns = {
    DiagnosticColumn{"area", &VesicleDiagnostics::area},
    DiagnosticColumn{"volume", &VesicleDiagnostics::volume},
    DiagnosticColumn{"reduced_volume", &VesicleDiagnostics::reduced_volume},
    DiagnosticColumn{"bending_energy_scaled", &VesicleDiagnostics::bending_energy_scaled},
    DiagnosticColumn{"tension_integral", &VesicleDiagnostics::tension_integral},
    DiagnosticColumn{"Vm_north", &VesicleDiagnostics::Vm_north},
    DiagnosticColumn{"q_north", &VesicleDiagnostics::q_north},
    DiagnosticColumn{"Vm_max", &VesicleDiagnostics::Vm_max},
    DiagnosticColumn{"extent_x", &VesicleDiagnostics::extent_x},
    DiagnosticColumn{"extent_y", &VesicleDiagnostics::extent_y},
    DiagnosticColumn{"extent_z", &VesicleDiagnostics::extent_z},
    DiagnosticColumn{"inclination_deg", &VesicleDiagnostics::inclination_deg},
    DiagnosticColumn{"area_drift", &VesicleDiagnostics::area_drift},
    DiagnosticColumn{"volume_drift", &VesicleDiagnostics::volume_drift},
    DiagnosticColumn{"strain_max", &VesicleDiagnostics::strain_max},
    DiagnosticColumn{"spectrum_tail", &VesicleDiagnostics::spectrum_tail},
};

std::string header() {
  std::vector<std::string> names{"time", "dt"};
  for (const DiagnosticColumn& column : diagnostic_columns) names.emplace_back(column.name);
  for (const char* name : {"iterations_flow", "iterations_electric", "rejected", "order", "truncation",
                           "error_estimate", "quadrature_error", "separation", "raw_area", "wrinkle_degree"}) {
    names.emplace_back(name);
  }
  return csv_line(names);
}

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

void require_history(const std::filesystem::path& path, std::int64_t kept_bytes, std::int64_t checksum) {
  if (kept_bytes == 0) return;
  std::error_code error;
  const auto size = static_cast<std::int64_t>(std::filesystem::file_size(path, error));
  if (error || size < kept_bytes) {
    throw InputError(fmt::format("{}: is missing or shorter than the {} bytes that the checkpoint counts",
                                 path.string(), kept_bytes));
  }
  std::ifstream kept(path, std::ios::binary);
  std::string first_line;
  std::getline(kept, first_line);
  if (first_line + "\n" != header()) throw InputError(fmt::format("{}:1: has other columns", path.string()));
  kept.seekg(0);
  if (checksum_of(kept, kept_bytes).value() != checksum) {
    throw InputError(fmt::format("{}: was altered: its first {} bytes do not match the checksum in checkpoint.h5",
                                 path.string(), kept_bytes));
  }
}

HistoryFile::HistoryFile(const std::filesystem::path& path, std::int64_t kept_bytes, std::int64_t checksum)
    : path_(path), checksum_(checksum) {
  if (kept_bytes == 0) {
    stream_.open(path, std::ios::binary | std::ios::trunc);
    write(header());
    return;
  }
  std::error_code error;
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(kept_bytes), error);
  if (error) throw OutputError(fmt::format("{}: cannot be written: {}", path.string(), error.message()));
  stream_.open(path, std::ios::binary | std::ios::app);
  bytes_ = kept_bytes;
}

void HistoryFile::append(const HistoryRow& row) {
  std::vector<std::string> cells;
  const auto number = [&cells](double value) { cells.push_back(fmt::format("{:.17g}", value)); };
  const auto count = [&cells](std::int64_t value) { cells.push_back(std::to_string(value)); };
  const StepAttempt& step = row.step;
  const VesicleDiagnostics& d = row.diagnostics.vesicles.front();
  number(row.time);
  number(step.dt);
  for (const DiagnosticColumn& column : diagnostic_columns) number(d.*column.member);
  for (const int value : {step.iterations_flow, step.iterations_electric, step.rejected, row.order}) count(value);
  for (const double value :
       {row.truncation, step.error_estimate, d.quadrature_error, d.separation, step.raw_area, d.wrinkle_degree}) {
    number(value);
  }
  write(csv_line(cells));
}

void HistoryFile::write(const std::string& text) {
  stream_ << text << std::flush;
  if (!stream_) {
    const std::string problem = write_problem(path_);
    // Closing tries once more to write what did not fit.
    stream_.close();
    std::error_code ignored;
    std::filesystem::resize_file(path_, static_cast<std::uintmax_t>(bytes_), ignored);
    throw OutputError(problem);
  }
  bytes_ += static_cast<std::int64_t>(text.size());
  checksum_.add(text);
}

HistoryTable::HistoryTable(const std::filesystem::path& path) {
  std::ifstream stream(path);
  *this = HistoryTable(stream, path.string());
}

HistoryTable::HistoryTable(std::istream& stream, std::string name) : file_(std::move(name)) {
  std::string line;
  if (!std::getline(stream, line)) throw InputError(fmt::format("{}: no such file or empty", file_));
  names_ = csv_cells(line);
  columns_.resize(names_.size());
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != names_.size()) {
      throw InputError(
          fmt::format("{}:{}: has {} columns; accepted: {}", file_, n_rows_ + 2, cells.size(), names_.size()));
    }
    for (std::size_t i = 0; i < cells.size(); ++i) columns_[i].push_back(std::strtod(cells[i].c_str(), nullptr));
    ++n_rows_;
  }
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

bool HistoryTable::has(const std::string& name) const { return std::ranges::find(names_, name) != names_.end(); }

const std::vector<double>& HistoryTable::column(const std::string& name) const {
  for (std::size_t i = 0; i < names_.size(); ++i) {
    if (names_[i] == name) return columns_[i];
  }
  throw InputError(fmt::format("{}:1: has no column {}", file_, name));
}

}  // namespace vehd
