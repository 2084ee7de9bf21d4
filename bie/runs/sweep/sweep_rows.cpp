#include "bie/runs/sweep/sweep_rows.hpp"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <sstream>

#include "bie/support/csv.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

SweepRows::SweepRows(const SweepPaths& paths) {
  const auto refuse = [&](const std::filesystem::path& file, const std::string& problem) {
    throw InputError(fmt::format("{}: {}; write it anew with vehd sweep", file.string(), problem));
  };
  const nlohmann::json json = nlohmann::json::parse(text_of_file(paths.description()), nullptr, false);
  try {
    is_grid_ = json.at("mode") == "grid";
    json.at("columns").get_to(columns_);
    for (const auto& key : json.at("keys")) keys_.push_back({key.at("name"), key.at("scale") == "log"});
  } catch (const nlohmann::json::exception&) {
    refuse(paths.description(), "describes no sweep");
  }
  std::istringstream text(text_of_file(paths.table()));
  std::string line;
  if (!std::getline(text, line)) refuse(paths.table(), "is no table");
  const std::size_t n_cells = quoted_csv_cells(line).size();
  if (n_cells != keys_.size() + columns_.size() + 4) refuse(paths.table(), "is no table of this sweep");
  for (int number = 2; std::getline(text, line); ++number) {
    rows_.push_back(quoted_csv_cells(line));
    if (rows_.back().size() == n_cells) continue;
    refuse(fmt::format("{}:{}", paths.table().string(), number),
           fmt::format("has {} cells instead of {}", rows_.back().size(), n_cells));
  }
}

double SweepRows::number(std::size_t row, std::size_t column) const {
  const std::string& text = rows_[row][keys_.size() + column];
  double value = std::numeric_limits<double>::quiet_NaN();
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

bool SweepRows::is_completed(std::size_t row) const {
  const std::string& verdict = rows_[row][keys_.size() + columns_.size()];
  const std::string& reason = rows_[row][keys_.size() + columns_.size() + 1];
  return verdict != "unfinished" && reason.empty();
}

bool is_sweep(const std::filesystem::path& directory) {
  std::error_code ignored;
  return std::filesystem::exists(SweepPaths{directory}.description(), ignored);
}

}  // namespace vehd
