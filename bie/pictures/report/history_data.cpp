#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "bie/pictures/history_panels.hpp"
#include "bie/pictures/report/packed_coefficients.hpp"
#include "bie/pictures/report/page_data.hpp"
#include "bie/runs/verdict.hpp"
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

namespace {

struct LimitMeaning {
  std::string_view column;
  std::string_view meaning;
};
constexpr std::array limit_meanings = {
    LimitMeaning{"area_drift", "change of the whole area since the start, relative; the membrane keeps it"},
    LimitMeaning{"volume_drift", "change of the volume since the start, relative; no fluid passes the membrane"},
    LimitMeaning{"strain_max", "largest local stretching of the membrane, which keeps the area of every piece"},
    LimitMeaning{"spectrum_tail",
                 "share of the highest third of the degrees in the shape, which estimates the part beyond the degree"},
    LimitMeaning{"quadrature_error", "error of the integrals where parts of the membrane are close, relative"},
    LimitMeaning{"truncation", "share of the shape that the highest allowed degree leaves out; limit: the tolerance"},
    LimitMeaning{"separation",
                 "least distance of parts of the membrane that face each other, in spacings of the grid"}};

std::string meaning_of(std::string_view column) {
  const auto found = std::ranges::find(limit_meanings, column, &LimitMeaning::column);
  return found == limit_meanings.end() ? std::string() : std::string(found->meaning);
}

nlohmann::json limit_row(const std::string& column, double worst, double limit, bool is_least) {
  const bool holds = is_least ? worst >= limit : worst <= limit;
  return {{"name", column}, {"worst", rounded_for_page(worst)}, {"limit", rounded_for_page(limit)}, {"least", is_least},
          {"holds", holds}, {"meaning", meaning_of(column)}};
}

std::string state_of(const std::string& verdict, bool has_ended) {
  if (!has_ended) return "unfinished";
  if (verdict == trustworthy) return "good";
  return verdict.starts_with("stopped") ? "stopped" : "doubtful";
}

}  // namespace

nlohmann::json verdict_data(const HistoryTable& history, const Scene& scene, const nlohmann::json& summary) {
  const TrustDemands demands = trust_demands(scene);
  const bool has_ended = summary.is_object() && summary.contains("verdict") && summary["verdict"].is_string();
  const auto verdict = has_ended ? summary["verdict"].get<std::string>() : verdict_of(history, demands);
  nlohmann::json json{{"text", has_ended ? verdict : "not finished (no summary.json); so far " + verdict},
                      {"state", state_of(verdict, has_ended)},
                      {"limits", nlohmann::json::array()},
                      {"warnings", nlohmann::json::array()}};
  // Runs of earlier versions have no warnings.
  if (has_ended && summary.contains("warnings")) {
    for (const auto& warning : summary["warnings"]) json["warnings"].push_back(warning.at("text"));
  }
  for (const TrustLimit& limit : trust_limits(demands)) {
    if (!history.has(limit.column)) continue;
    json["limits"].push_back(limit_row(limit.column, history.largest_magnitude(limit.column), limit.largest, false));
  }
  if (history.has("separation")) {
    double least = INFINITY;
    for (const double value : history.column("separation")) least = value < least || std::isnan(value) ? value : least;
    // Infinite if no part of the membrane faces another.
    if (!std::isinf(least)) json["limits"].push_back(limit_row("separation", least, least_trusted_separation, true));
  }
  return json;
}

}  // namespace vehd
