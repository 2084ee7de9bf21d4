#include "bie/pictures/sweep_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <sstream>

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
  for (std::string line; std::getline(text, line);) cells.push_back(quoted_csv_cells(line));
  const auto fits = [&](const auto& row) { return row.size() == keys.size() + columns.size() + 4; };
  if (cells.empty() || !std::ranges::all_of(cells, fits)) refuse(paths.table(), "is no table of this sweep");
  cells.erase(cells.begin());
}

double SweepRows::number(std::size_t row, std::size_t column) const {
  const std::string& text = cells[row][keys.size() + column];
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool SweepRows::is_completed(std::size_t row) const {
  const auto verdict = cells[row].begin() + static_cast<std::ptrdiff_t>(keys.size() + columns.size());
  return verdict[0] != "unfinished" && verdict[1].empty();
}

bool is_sweep(const std::filesystem::path& directory) {
  std::error_code ignored;
  return std::filesystem::exists(SweepPaths{directory}.description(), ignored);
}

}  // namespace vehd
