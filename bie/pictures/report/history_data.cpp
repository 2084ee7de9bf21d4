#include "bie/pictures/report/history_data.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {
namespace {

struct ReportCurve {
  const char* column;
  const char* label;
};

struct ReportPanel {
  const char* title;
  std::vector<ReportCurve> curves;
  bool is_shown = true;
  bool is_logarithmic = false;
};

std::vector<ReportPanel> report_panels(const Scene& scene) {
  const bool electric = scene.electric.has_value();
  return {
      {"Bending energy ∫H² dA", {{"bending_energy_scaled", "∫H² dA"}}},
      {"Tension ∫λ dA", {{"tension_integral", "∫λ dA"}}, scene.membrane.inextensible},
      {"Potential across the membrane", {{"Vm_north", "V_m at the north pole"}, {"Vm_max", "largest |V_m|"}}, electric},
      {"Charge density", {{"q_north", "q at the north pole"}}, electric},
      {"Extents", {{"extent_x", "along x"}, {"extent_y", "along y"}, {"extent_z", "along z"}}},
      {"Inclination of the long axis, degrees", {{"inclination_deg", "inclination"}}, scene.flow.has_value()},
      {"Errors",
       {{"area_drift", "area drift"},
        {"volume_drift", "volume drift"},
        {"strain_max", "local strain"},
        {"spectrum_tail", "spectrum tail"}},
       true,
       true},
      {"Step", {{"dt", "dt"}}, scene.numerics.tolerance.has_value(), true},
      {"Degree", {{"order", "p"}}, scene.numerics.tolerance.has_value()}};
}

/// Rows to draw: all, or of each of many stretches of the history those where a curve is lowest and highest.
std::vector<std::size_t> rows_to_draw(const std::vector<const std::vector<double>*>& curves, std::size_t n_rows) {
  constexpr std::size_t n_stretches = 400;
  std::set<std::size_t> rows;
  const std::size_t length = std::max<std::size_t>(1, n_rows / n_stretches);
  for (std::size_t start = 0; start < n_rows; start += length) {
    const auto end = static_cast<std::ptrdiff_t>(std::min(n_rows, start + length));
    for (const std::vector<double>* curve : curves) {
      const auto [low, high] =
          std::minmax_element(curve->begin() + static_cast<std::ptrdiff_t>(start), curve->begin() + end);
      rows.insert(static_cast<std::size_t>(low - curve->begin()));
      rows.insert(static_cast<std::size_t>(high - curve->begin()));
    }
  }
  rows.insert({0, n_rows - 1});
  return {rows.begin(), rows.end()};
}

nlohmann::json values_at(const std::vector<double>& values, const std::vector<std::size_t>& rows, bool magnitude) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::size_t row : rows) list.push_back(rounded_for_page(magnitude ? std::abs(values[row]) : values[row]));
  return list;
}

nlohmann::json panel_data(const ReportPanel& panel, const HistoryTable& history) {
  std::vector<const std::vector<double>*> columns;
  std::vector<ReportCurve> curves;
  for (const ReportCurve& curve : panel.curves) {
    if (!history.has(curve.column)) continue;
    columns.push_back(&history.column(curve.column));
    curves.push_back(curve);
  }
  if (curves.empty()) return nullptr;
  const std::vector<std::size_t> rows = rows_to_draw(columns, history.n_rows());
  nlohmann::json json{{"title", panel.title},
                      {"unit", printed_unit(history.unit(curves.front().column))},
                      {"log", panel.is_logarithmic}};
  json["time"] = values_at(history.column("time"), rows, false);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    json["curves"].push_back(
        {{"label", curves[i].label}, {"values", values_at(*columns[i], rows, panel.is_logarithmic)}});
  }
  return json;
}

}  // namespace

nlohmann::json history_data(const HistoryTable& history, const Scene& scene) {
  nlohmann::json json{{"unit", printed_unit(history.unit("time"))}, {"panels", nlohmann::json::array()}};
  if (history.n_rows() < 2) return json;
  for (const ReportPanel& panel : report_panels(scene)) {
    if (!panel.is_shown) continue;
    nlohmann::json data = panel_data(panel, history);
    if (!data.is_null()) json["panels"].push_back(std::move(data));
  }
  return json;
}

}  // namespace vehd
