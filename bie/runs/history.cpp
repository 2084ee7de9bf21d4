#include "bie/runs/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <string_view>
#include <utility>

#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"
#include "bie/support/output_error.hpp"

namespace vehd {
namespace {

template <auto member>
double of_vesicle(const HistoryRow& row) {
  return row.diagnostics.vesicles.front().*member;
}
template <auto member>
double of_step(const HistoryRow& row) {
  return static_cast<double>(row.step.*member);
}
template <auto member>
double of_row(const HistoryRow& row) {
  return static_cast<double>(row.*member);
}

using D = VesicleDiagnostics;

std::string header_of(std::string_view name, const std::string& unit) {
  return unit.empty() ? std::string(name) : fmt::format("{} [{}]", name, unit);
}

std::string header_line(const OutputUnits& units, HistoryKind kind) {
  std::vector<std::string> cells;
  for (const HistoryColumn& column : history_columns(kind)) {
    cells.push_back(header_of(column.name, units.of(column.dimension).symbol));
  }
  return csv_line(cells);
}

/// Name and unit of a header.
std::pair<std::string, std::string> parts_of(const std::string& header) {
  const std::size_t at = header.find(" [");
  if (at == std::string::npos || !header.ends_with(']')) return {header, ""};
  return {header.substr(0, at), header.substr(at + 2, header.size() - at - 3)};
}

bool is_header(const std::string& line, HistoryKind kind) {
  const std::vector<std::string> cells = csv_cells(line);
  return std::ranges::equal(
      cells, history_columns(kind), {}, [](const std::string& cell) { return parts_of(cell).first; },
      &HistoryColumn::name);
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

namespace {

/// Behind all others where there is poration.
std::vector<HistoryColumn> columns_of(PorationModel model) {
  switch (model) {
    case PorationModel::porosity:
      return {{"conductance_max", "conductance/area", of_vesicle<&D::conductance_max>},
              {"porosity_max", "1", of_vesicle<&D::poration_max>},
              {"porosity_mean", "1", of_vesicle<&D::poration_mean>}};
    case PorationModel::pores:
      return {{"conductance_max", "conductance/area", of_vesicle<&D::conductance_max>},
              {"pore_density_max", "1/area", of_vesicle<&D::poration_max>},
              {"pore_density_mean", "1/area", of_vesicle<&D::poration_mean>}};
    case PorationModel::criterion:
      break;
  }
  return {{"poration_load", "1", of_vesicle<&D::poration_load>},
          {"poration_time", "time", of_vesicle<&D::poration_time>},
          {"poration_x", "length", of_vesicle<&D::poration_x>},
          {"poration_y", "length", of_vesicle<&D::poration_y>},
          {"poration_z", "length", of_vesicle<&D::poration_z>}};
}

const std::vector<HistoryColumn>& columns_of_one() {
  static const std::vector<HistoryColumn> all = {
      {"time", "time", of_row<&HistoryRow::time>},
      {"dt", "time", of_step<&StepAttempt::dt>},
      {"area", "area", of_vesicle<&D::area>},
      {"volume", "volume", of_vesicle<&D::volume>},
      {"reduced_volume", "1", of_vesicle<&D::reduced_volume>},
      {"bending_energy_scaled", "1", of_vesicle<&D::bending_energy_scaled>},
      {"tension_integral", "energy", of_vesicle<&D::tension_integral>},
      {"Vm_north", "potential", of_vesicle<&D::Vm_north>},
      {"q_north", "potential/length", of_vesicle<&D::q_north>},
      {"Vm_max", "potential", of_vesicle<&D::Vm_max>},
      {"extent_x", "length", of_vesicle<&D::extent_x>},
      {"extent_y", "length", of_vesicle<&D::extent_y>},
      {"extent_z", "length", of_vesicle<&D::extent_z>},
      {"inclination_deg", "1", of_vesicle<&D::inclination_deg>},
      {"area_drift", "1", of_vesicle<&D::area_drift>},
      {"volume_drift", "1", of_vesicle<&D::volume_drift>},
      {"strain_max", "1", of_vesicle<&D::strain_max>},
      {"spectrum_tail", "1", of_vesicle<&D::spectrum_tail>},
      {"iterations_flow", "1", of_step<&StepAttempt::iterations_flow>},
      {"iterations_electric", "1", of_step<&StepAttempt::iterations_electric>},
      {"rejected", "1", of_step<&StepAttempt::rejected>},
      {"order", "1", of_row<&HistoryRow::order>},
      {"truncation", "1", of_row<&HistoryRow::truncation>},
      {"error_estimate", "1", of_step<&StepAttempt::error_estimate>},
      {"quadrature_error", "1", of_vesicle<&D::quadrature_error>},
      {"separation", "1", of_vesicle<&D::separation>},
      {"raw_area", "1", of_step<&StepAttempt::raw_area>},
      {"wrinkle_degree", "1", of_vesicle<&D::wrinkle_degree>},
      {"centroid_x", "length", of_vesicle<&D::centroid_x>},
      {"centroid_y", "length", of_vesicle<&D::centroid_y>},
      {"centroid_z", "length", of_vesicle<&D::centroid_z>},
      {"centroid_velocity_x", "velocity", of_vesicle<&D::centroid_velocity_x>},
      {"centroid_velocity_y", "velocity", of_vesicle<&D::centroid_velocity_y>},
      {"centroid_velocity_z", "velocity", of_vesicle<&D::centroid_velocity_z>},
      {"tension_max", "force/length", of_vesicle<&D::tension_max>},
      {"elastic_energy_scaled", "1", of_vesicle<&D::elastic_energy_scaled>},
      {"aspect_ratio", "1", of_vesicle<&D::aspect_ratio>},
      {"aspect_ratio_field", "1", of_vesicle<&D::aspect_ratio_field>},
      {"Vm_pole_plus", "potential", of_vesicle<&D::Vm_pole_plus>},
      {"Vm_pole_minus", "potential", of_vesicle<&D::Vm_pole_minus>},
      {"Vm_phase_deg", "1", of_vesicle<&D::Vm_phase_deg>},
  };
  return all;
}

std::vector<HistoryColumn> columns_named(std::initializer_list<std::string_view> names) {
  std::vector<HistoryColumn> columns;
  for (const std::string_view name : names) {
    columns.push_back(*std::ranges::find(columns_of_one(), name, &HistoryColumn::name));
  }
  return columns;
}

const std::vector<HistoryColumn>& columns_of_all() {
  static const std::vector<HistoryColumn> all = [] {
    auto columns = columns_named({"time",
                                  "dt",
                                  "bending_energy_scaled",
                                  "tension_integral",
                                  "Vm_max",
                                  "area_drift",
                                  "volume_drift",
                                  "strain_max",
                                  "spectrum_tail",
                                  "iterations_flow",
                                  "iterations_electric",
                                  "rejected",
                                  "order",
                                  "truncation",
                                  "error_estimate",
                                  "quadrature_error",
                                  "separation",
                                  "raw_area",
                                  "wrinkle_degree",
                                  "tension_max",
                                  "elastic_energy_scaled"});
    columns.push_back({"smallest_gap", "length", [](const HistoryRow& row) { return row.gap.distance; }});
    columns.push_back({"gap_vesicle_a", "1", [](const HistoryRow& row) { return static_cast<double>(row.gap.first); }});
    columns.push_back(
        {"gap_vesicle_b", "1", [](const HistoryRow& row) { return static_cast<double>(row.gap.second); }});
    columns.push_back({"gap_degree", "1", [](const HistoryRow& row) { return row.gap.degree(); }});
    return columns;
  }();
  return all;
}

/// What one vesicle has of its own.
const std::vector<HistoryColumn>& columns_of_each() {
  static const std::vector<HistoryColumn> all = [] {
    std::vector<HistoryColumn> columns = {columns_of_one().front(), {"vesicle", "1", of_row<&HistoryRow::vesicle>}};
    for (const HistoryColumn& column : columns_of_one()) {
      constexpr std::array of_the_step = {"time",     "dt",         "iterations_flow", "iterations_electric",
                                          "rejected", "truncation", "error_estimate",  "raw_area"};
      if (std::ranges::find(of_the_step, column.name) == of_the_step.end()) columns.push_back(column);
    }
    return columns;
  }();
  return all;
}

}  // namespace

const std::vector<HistoryColumn>& history_columns(HistoryKind kind) {
  static const std::array usual = {&columns_of_one(), &columns_of_all(), &columns_of_each()};
  if (!kind.poration) return *usual.at(kind.rows);
  static const auto with_poration = [] {
    std::array<std::array<std::vector<HistoryColumn>, 3>, n_poration_models> all;
    for (std::size_t model = 0; model < all.size(); ++model) {
      const std::vector<HistoryColumn> further = columns_of(static_cast<PorationModel>(model));
      for (std::size_t rows = 0; rows < usual.size(); ++rows) {
        std::vector<HistoryColumn>& columns = all.at(model).at(rows) = *usual.at(rows);
        columns.insert(columns.end(), further.begin(), further.end());
      }
    }
    return all;
  }();
  return with_poration.at(static_cast<std::size_t>(*kind.poration)).at(kind.rows);
}

HistoryKind history_kind(const Scene& scene) {
  HistoryKind kind(scene.vesicles.size() > 1 ? HistoryKind::of_all : HistoryKind::of_one);
  if (scene.poration) kind.poration = scene.poration->model;
  return kind;
}

HistoryKind of_each_like(HistoryKind kind) {
  kind.rows = HistoryKind::of_each;
  return kind;
}

void require_history(const std::filesystem::path& path, std::int64_t kept_bytes, std::int64_t checksum,
                     HistoryKind kind) {
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
  if (!is_header(first_line, kind)) throw InputError(fmt::format("{}:1: has other columns", path.string()));
  kept.seekg(0);
  if (checksum_of(kept, kept_bytes).value() != checksum) {
    throw InputError(fmt::format("{}: was altered: its first {} bytes do not match the checksum in checkpoint.h5",
                                 path.string(), kept_bytes));
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

void HistoryFile::append(const HistoryRow& row) {
  std::vector<std::string> cells;
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    cells.push_back(fmt::format("{:.17g}", history_columns(kind_)[i].value(row) * factors_[i]));
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
  for (const std::string& cell : csv_cells(line)) {
    auto [plain, unit] = parts_of(cell);
    names_.push_back(std::move(plain));
    units_.push_back(std::move(unit));
  }
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
  for (std::size_t i = 0; i < factors_.size(); ++i) {
    columns_[i].push_back(history_columns(kind_)[i].value(row) * factors_[i]);
  }
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

OutputUnits HistoryTable::units(std::optional<UnitsScene> scales) const {
  std::map<std::string, std::string, std::less<>> symbols;
  const auto add = [&](const HistoryColumn& column) {
    const auto found = std::ranges::find(names_, column.name);
    if (found == names_.end()) return;
    const std::string& symbol = units_[static_cast<std::size_t>(found - names_.begin())];
    if (!symbol.empty()) symbols.emplace(column.dimension, symbol);
  };
  std::ranges::for_each(history_columns(), add);
  for (std::size_t model = 0; model < n_poration_models; ++model) {
    std::ranges::for_each(columns_of(static_cast<PorationModel>(model)), add);
  }
  return {std::move(scales), std::move(symbols)};
}

}  // namespace vehd
