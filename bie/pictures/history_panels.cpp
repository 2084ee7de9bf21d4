#include "bie/pictures/history_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "bie/support/errors.hpp"

namespace vehd {
namespace {

/// What is worth showing: from a tenth of what the verdict allows.
struct Drift {
  const char* column;
  const char* label;
  double least;
};
constexpr std::array drifts = {Drift{"area_drift", "area", 1e-7}, Drift{"volume_drift", "volume", 1e-7},
                               Drift{"strain_max", "local strain", 5e-3}};

bool has_numbers(const std::vector<double>& values) {
  return std::ranges::count_if(values, [](double value) { return std::isfinite(value); }) > 1;
}

/// Files of earlier programs lack columns.
std::optional<std::vector<double>> column_of(const HistoryTable& history, const std::string& name) {
  try {
    return history.column(name);
  } catch (const InputError&) {
    return std::nullopt;
  }
}

class Panels {
 public:
  explicit Panels(const HistoryTable& history) : history_(history) {}

  struct Wanted {
    const char* column;
    const char* label;
  };

  void add_columns(const std::vector<Wanted>& wanted) {
    HistoryPanel panel;
    for (const Wanted& curve : wanted) {
      if (auto values = column_of(history_, curve.column)) {
        panel.curves.push_back({curve.label, history_.unit(curve.column), std::move(*values)});
      }
    }
    add(std::move(panel));
  }

  void add(HistoryPanel panel) {
    std::erase_if(panel.curves, [](const HistoryCurve& curve) { return !has_numbers(curve.values); });
    if (!panel.curves.empty()) panels.push_back(std::move(panel));
  }

  std::vector<HistoryPanel> panels;

 private:
  const HistoryTable& history_;
};

/// Magnitudes, of which a logarithmic axis shows all but zero.
HistoryPanel drift_panel(const HistoryTable& history) {
  HistoryPanel panel{{}, "drift", true};
  bool matters = false;
  for (const Drift& drift : drifts) {
    auto values = column_of(history, drift.column);
    if (!values) continue;
    for (double& value : *values) {
      value = value == 0.0 ? std::numeric_limits<double>::quiet_NaN() : std::abs(value);
      matters = matters || value >= drift.least;
    }
    panel.curves.push_back({drift.label, "", std::move(*values)});
  }
  return matters ? panel : HistoryPanel{};
}

HistoryPanel extent_panel(const HistoryTable& history) {
  HistoryPanel panel{{}, "extent"};
  for (const auto& [column, label] :
       {std::pair{"extent_x", "x"}, std::pair{"extent_y", "y"}, std::pair{"extent_z", "z"}}) {
    if (auto values = column_of(history, column))
      panel.curves.push_back({label, history.unit(column), std::move(*values)});
  }
  return panel;
}

}  // namespace

HistoryCurve aspect_curve(const HistoryTable& history) {
  if (auto column = column_of(history, "aspect_ratio")) return {"aspect ratio", "", std::move(*column)};
  HistoryCurve curve{"longest / shortest extent", "", {}};
  const auto x = column_of(history, "extent_x"), y = column_of(history, "extent_y"), z = column_of(history, "extent_z");
  if (!x || !y || !z) return curve;
  for (std::size_t i = 0; i < x->size(); ++i) {
    const auto [least, most] = std::minmax({(*x)[i], (*y)[i], (*z)[i]});
    curve.values.push_back(most / least);
  }
  return curve;
}

std::vector<HistoryPanel> panels_of(const Scene& scene, const HistoryTable& history) {
  Panels panels(history);
  panels.add_columns({{"bending_energy_scaled", "bending energy ∫H^2 dγ"}, {"tension_integral", "tension ∫λ dγ"}});
  if (scene.electric) {
    panels.add_columns({{"Vm_north", "V_m at the north pole"}, {"q_north", "q at the north pole"}});
  }
  HistoryPanel shape{{aspect_curve(history)}};
  const auto inclination = column_of(history, "inclination_deg");
  if (scene.flow && inclination) {
    shape.curves.insert(shape.curves.begin(), {"inclination (degrees)", "", *inclination});
  }
  panels.add(std::move(shape));
  panels.add(drift_panel(history));
  // Two stand side by side.
  if (panels.panels.size() % 2 == 1) panels.add(extent_panel(history));
  return std::move(panels.panels);
}

}  // namespace vehd
