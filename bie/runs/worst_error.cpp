#include "bie/runs/worst_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vehd {
namespace {

constexpr std::array<const char*, 12> counted = {"reduced_volume",   "bending_energy_scaled",
                                                 "tension_integral", "Vm_north",
                                                 "q_north",          "Vm_max",
                                                 "extent_x",         "extent_y",
                                                 "extent_z",         "inclination_deg",
                                                 "smallest_gap",     "gap_wall"};

}  // namespace

double size_of_column(const HistoryTable& history, const std::string& name) {
  if (!history.has(name) || std::ranges::find(counted, name) == counted.end()) return 0.0;
  if (name == "inclination_deg") return 180.0 / std::numbers::pi;
  if (name.ends_with("_north")) {
    // Zero by symmetry: far smaller than at the poles of a field along z.
    constexpr double of_symmetry = 1e-9;
    if (history.largest_magnitude("Vm_north") <= of_symmetry * history.largest_magnitude("Vm_max")) return 0.0;
  }
  const double size = history.largest_magnitude(name);
  return std::isfinite(size) ? size : 0.0;
}

nlohmann::json worst_error(const HistoryTable& history, const HistoryTable& errors) {
  nlohmann::json json{{"rows", errors.n_rows()}};
  double worst = -1.0;
  for (const std::string name : counted) {
    const double size = size_of_column(history, name);
    if (!(size > 0.0) || !errors.has(name)) continue;
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
