#include "bie/pictures/sweep_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <string>

#include "bie/scene/units.hpp"
#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

SweepRows::SweepRows(const SweepPaths& paths) {
  const auto refuse = [](const std::filesystem::path& file, const char* problem) {
    throw InputError(fmt::format("{}: {}; write it anew with vehd sweep", file.string(), problem));
  };
  const nlohmann::json json = nlohmann::json::parse(text_of_file(paths.description()), nullptr, false);
  try {
    is_grid = json.at("mode") == "grid";
    json.at("columns").get_to(columns);
    for (const auto& key : json.at("keys")) keys.push_back({key.at("name"), key.at("scale") == "log"});
  } catch (const nlohmann::json::exception&) {
    refuse(paths.description(), "describes no sweep");
  }
  std::istringstream text(text_of_file(paths.table()));
  for (std::string line; std::getline(text, line);) cells.push_back(csv_cells(line));
  const auto fits = [&](const auto& row) { return row.size() == keys.size() + columns.size() + 4; };
  if (cells.empty() || !std::ranges::all_of(cells, fits)) refuse(paths.table(), "is not a table of this sweep");
  cells.erase(cells.begin());
}

double SweepRows::number(std::size_t row, std::size_t column) const {
  return number_of_cell(cells[row][keys.size() + column]);
}

std::vector<double> SweepRows::numbers(std::size_t column) const {
  std::vector<double> result;
  for (std::size_t row = 0; row < n_rows(); ++row) result.push_back(number(row, column));
  return result;
}

bool SweepRows::is_completed(std::size_t row) const {
  const auto verdict = cells[row].begin() + static_cast<std::ptrdiff_t>(keys.size() + columns.size());
  return verdict[0] != "unfinished" && verdict[1].empty();
}

bool is_sweep(const std::filesystem::path& directory) {
  std::error_code ignored;
  return std::filesystem::exists(SweepPaths{directory}.description(), ignored);
}

namespace {

/// Positions of the values of one key in a map.
class CellScale {
 public:
  CellScale(const SweepRows& rows, std::size_t key, const std::string& file) : key_(rows.keys[key]) {
    for (std::size_t row = 0; row < rows.n_rows(); ++row) {
      const auto quantity = parse_quantity(rows.cells[row][key]);
      if (!quantity || (row > 0 && quantity->unit != unit_)) {
        throw InputError(fmt::format("{}: no curve can be drawn over \"{}\", whose values are not numbers of one unit",
                                     file, key_.name));
      }
      unit_ = quantity->unit;
      const double value = scaled(quantity->number);
      if (std::ranges::find(values_, value) == values_.end()) values_.push_back(value);
    }
    if (values_.size() < 2) throw InputError(fmt::format("{}: \"{}\" has a single value", file, key_.name));
  }

  /// Position 0 ... 1 in the map; a value outside of the map has another one, or NaN.
  [[nodiscard]] double place_of(const std::string& text, const std::string& where) const {
    const auto quantity = parse_quantity(text);
    if (!quantity || quantity->unit != unit_) {
      throw InputError(fmt::format("{}: {} of \"{}\"; accepted: a number{}", where, text, key_.name,
                                   unit_.empty() ? "" : fmt::format(" in \"{}\"", unit_)));
    }
    const double value = scaled(quantity->number);
    // Values in the outer halves of the first and the last cell are extrapolated from the next cell.
    std::size_t cell = 0;
    const bool rising = values_.back() > values_.front();
    while (cell + 2 < values_.size() && (rising ? value > values_[cell + 1] : value < values_[cell + 1])) ++cell;
    const double within = (value - values_[cell]) / (values_[cell + 1] - values_[cell]);
    return (static_cast<double>(cell) + within + 0.5) / static_cast<double>(values_.size());
  }

 private:
  [[nodiscard]] double scaled(double value) const { return key_.is_logarithmic ? std::log(value) : value; }

  SweepRows::Key key_;
  std::string unit_;
  std::vector<double> values_;
};

}  // namespace

std::vector<SweepCurve> read_sweep_curves(const std::filesystem::path& path, const SweepRows& rows) {
  const std::string file = path.string();
  const std::array<CellScale, 2> scales{CellScale(rows, 0, file), CellScale(rows, 1, file)};
  std::istringstream text(text_of_file(path));
  std::string line;
  std::getline(text, line);
  const std::vector<std::string> header = csv_cells(line);
  std::array<std::size_t, 2> cell_of_key{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto found = std::ranges::find(header, rows.keys[k].name);
    if (found == header.end()) {
      throw InputError(fmt::format("{}:1: names no \"{}\", a key of the sweep", file, rows.keys[k].name));
    }
    cell_of_key[k] = static_cast<std::size_t>(found - header.begin());
  }
  std::vector<SweepCurve> curves(1);
  const auto end_curve = [&] {
    if (!curves.back().empty()) curves.emplace_back();
  };
  for (int number = 2; std::getline(text, line); ++number) {
    if (line.empty() || line == "\r") {
      end_curve();
      continue;
    }
    const std::string where = fmt::format("{}:{}", file, number);
    const std::vector<std::string> cells = csv_cells(line);
    if (cells.size() != header.size()) {
      throw InputError(fmt::format("{}: has {} cells instead of {}", where, cells.size(), header.size()));
    }
    PagePoint point{};
    for (std::size_t k = 0; k < 2; ++k) point[k] = scales[k].place_of(cells[cell_of_key[k]], where);
    const auto on_map = [](double place) { return place >= 0.0 && place <= 1.0; };
    if (on_map(point[0]) && on_map(point[1])) {
      curves.back().push_back(point);
    } else {
      end_curve();
    }
  }
  std::erase_if(curves, [](const SweepCurve& curve) { return curve.size() < 2; });
  return curves;
}

}  // namespace vehd
