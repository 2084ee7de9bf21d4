#include "bie/pictures/report/history_data.hpp"

#include <string>
#include <vector>

#include "bie/pictures/history_panels.hpp"
#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {
namespace {

/// More would be finer than the pixels of a plot.
constexpr std::size_t page_stretches = 400;

nlohmann::json values_at(const std::vector<double>& values, const std::vector<std::size_t>& rows) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::size_t row : rows) list.push_back(rounded_for_page(values[row]));
  return list;
}

nlohmann::json panel_data(const HistoryQuantity& quantity, const std::vector<double>& times) {
  const std::vector<std::size_t> rows = rows_to_draw(quantity.curves, page_stretches);
  nlohmann::json json{{"title", quantity.label},
                      {"unit", printed_unit(quantity.unit)},
                      {"log", quantity.is_logarithmic},
                      {"time", values_at(times, rows)}};
  for (const HistoryCurve& curve : quantity.curves) {
    json["curves"].push_back({{"label", curve.label}, {"values", values_at(curve.values, rows)}});
  }
  return json;
}

}  // namespace

nlohmann::json history_data(const HistoryTable& history, const Scene& scene) {
  nlohmann::json json{{"unit", printed_unit(history.unit("time"))}, {"panels", nlohmann::json::array()}};
  for (const HistoryQuantity& quantity : history_quantities(scene, history)) {
    json["panels"].push_back(panel_data(quantity, history.column("time")));
  }
  return json;
}

}  // namespace vehd
