#include "bie/runs/worst_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

namespace vehd {
namespace {

constexpr std::array<std::string_view, 11> counted = {"reduced_volume",   "bending_energy_scaled",
                                                      "tension_integral", "Vm_north",
                                                      "q_north",          "Vm_max",
                                                      "extent_x",         "extent_y",
                                                      "extent_z",         "inclination_deg",
                                                      "smallest_gap"};

}  // namespace

double size_of_column(std::string_view name, const std::function<double(const std::string& name)>& largest) {
  if (std::ranges::find(counted, name) == counted.end()) return 0.0;
  if (name == "inclination_deg") return 180.0 / std::numbers::pi;
  if (name.ends_with("_north")) {
    // Far below what the poles have where the field points along them.
    constexpr double of_symmetry = 1e-9;
    if (largest("Vm_north") <= of_symmetry * largest("Vm_max")) return 0.0;
  }
  const double size = largest(std::string(name));
  return std::isfinite(size) ? size : 0.0;
}

nlohmann::json worst_error(const HistoryTable& history, const HistoryTable& errors) {
  nlohmann::json json{{"rows", errors.n_rows()}};
  double worst = -1.0;
  const auto largest = [&](const std::string& name) { return history.largest_magnitude(name); };
  for (const std::string_view column_name : counted) {
    const std::string name(column_name);
    if (!errors.has(name) || !history.has(name)) continue;
    const double size = size_of_column(name, largest);
    if (!(size > 0.0)) continue;
    const std::vector<double>& column = errors.column(name);
    for (std::size_t row = 0; row < column.size(); ++row) {
      const double error = column[row] / size;
      if (!(error > worst)) continue;
      worst = error;
      const double time = errors.column("time")[row];
      json["worst"] = worst;
      json["column"] = name;
      json["time"] = time;
      json["text"] = fmt::format("{:.1e} of {} at time {}", worst, name, errors.time_text(time));
    }
  }
  return json;
}

}  // namespace vehd
