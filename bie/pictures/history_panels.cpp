#include "bie/pictures/history_panels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <utility>

namespace vehd {
namespace {

struct ColumnRow {
  const char* column;
  const char* label;
};

enum class Shown {
  always,
  with_field,
  with_averaged_field,
  with_poration,
  with_flow,
  with_linear_flow,
  with_drift,
  with_tolerance
};

constexpr const char* step_size = "dt";

struct QuantityRow {
  std::string_view label;
  std::vector<ColumnRow> columns;
  Shown shown = Shown::always;
  bool is_logarithmic = false;
};

/// Labels of the quantities from which a picture chooses.
namespace shown_quantity {
constexpr std::string_view energy = "bending energy", tension = "tension", potential = "potential across the membrane",
                           charge = "charge density", inclination = "inclination", aspect = "aspect ratio",
                           errors = "errors", extent = "extent", centroid = "centroid", gap = "gap",
                           viscosity = "viscosity", dipole = "dipole", poration = "poration", pores = "pores";
}  // namespace shown_quantity

const std::vector<QuantityRow>& quantity_rows() {
  static const std::vector<QuantityRow> rows = {
      {shown_quantity::energy, {{"bending_energy_scaled", "bending energy ∫H² dA"}}},
      {shown_quantity::tension, {{"tension_integral", "tension ∫λ dA"}}},
      {shown_quantity::potential,
       {{"Vm_north", "V_m at the north pole"}, {"Vm_max", "largest |V_m|"}},
       Shown::with_field},
      {shown_quantity::potential,
       {{"Vm_north", "|V_m| at the north pole"}, {"Vm_max", "largest |V_m|"}},
       Shown::with_averaged_field},
      {shown_quantity::charge, {{"q_north", "q at the north pole"}}, Shown::with_field},
      {shown_quantity::charge, {{"q_north", "|q| at the north pole"}}, Shown::with_averaged_field},
      {"phase of the potential", {{"Vm_phase_deg", "phase of V_m (degrees)"}}, Shown::with_averaged_field},
      {shown_quantity::poration,
       {{"poration_load", "share of the threshold of poration"}, {"porosity_max", "largest porosity"}},
       Shown::with_poration},
      {shown_quantity::pores,
       {{"pore_density_max", "largest"}, {"pore_density_mean", "mean"}},
       Shown::with_poration,
       true},
      {shown_quantity::inclination, {{"inclination_deg", "inclination (degrees)"}}, Shown::with_flow},
      {shown_quantity::aspect,
       {{"aspect_ratio_field", "aspect ratio along the field"}, {"aspect_ratio", "aspect ratio"}}},
      {shown_quantity::centroid,
       {{"centroid_x", "along x"}, {"centroid_y", "along y"}, {"centroid_z", "along z"}},
       Shown::with_drift},
      {shown_quantity::errors,
       {{"area_drift", "area"}, {"volume_drift", "volume"}, {"strain_max", "local strain"}, {"spectrum_tail", "tail"}},
       Shown::always,
       true},
      {shown_quantity::gap, {{"smallest_gap", "smallest gap"}}},
      {shown_quantity::viscosity,
       {{"effective_viscosity_intrinsic", "intrinsic viscosity of all"}},
       Shown::with_linear_flow},
      {shown_quantity::dipole,
       {{"dipole_x", "dipole along x"}, {"dipole_y", "along y"}, {"dipole_z", "along z"}},
       Shown::with_field},
      {shown_quantity::extent, {{"extent_x", "along x"}, {"extent_y", "along y"}, {"extent_z", "along z"}}},
      {"step", {{step_size, "dt"}}, Shown::with_tolerance, true},
      {"degree", {{"order", "p"}}, Shown::with_tolerance}};
  return rows;
}

/// Drifts are shown from a tenth of the limit of the verdict.
struct LeastDrift {
  const char* column;
  double least;
};
constexpr std::array least_drifts = {LeastDrift{"area_drift", 1e-7}, LeastDrift{"volume_drift", 1e-7},
                                     LeastDrift{"strain_max", 5e-3}};

bool applies(Shown shown, const Scene& scene) {
  switch (shown) {
    case Shown::with_field:
      return scene.electric.has_value() && !has_averaged_field(scene);
    case Shown::with_averaged_field:
      return has_averaged_field(scene);
    case Shown::with_poration:
      return scene.poration.has_value();
    case Shown::with_flow:
      return scene.flow.has_value();
    case Shown::with_linear_flow:
      return scene.flow.has_value() && scene.flow->kind != FlowKind::poiseuille;
    case Shown::with_drift:
      return scene.gravity.has_value() || scene.membrane.pump.has_value();
    case Shown::with_tolerance:
      return scene.numerics.tolerance.has_value();
    case Shown::always:
      break;
  }
  return true;
}

bool has_numbers(const std::vector<double>& values) {
  return std::ranges::count_if(values, [](double value) { return std::isfinite(value); }) > 1;
}

/// Zero becomes NaN, since a logarithmic axis cannot show it.
std::vector<double> magnitudes(std::vector<double> values) {
  for (double& value : values) {
    value = value == 0.0 ? std::numeric_limits<double>::quiet_NaN() : std::abs(value);
  }
  return values;
}

/// A row within a step has dt 0 and shows the size of that step.
std::vector<double> sizes_of_steps(std::vector<double> sizes) {
  for (std::size_t i = sizes.size(); i-- > 1;) {
    if (sizes[i - 1] == 0.0) sizes[i - 1] = sizes[i];
  }
  return sizes;
}

/// Number of turning points after which a curve goes back by more than a hundredth of its range; less is rounding.
std::size_t turns_of(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  const double back = 0.01 * (most - least);
  std::size_t n_turns = 0;
  double extreme = values.front();
  bool rises = true;
  for (const double value : values) {
    if (rises ? value > extreme : value < extreme) extreme = value;
    if (std::abs(value - extreme) > back) {
      ++n_turns;
      rises = !rises;
      extreme = value;
    }
  }
  return n_turns;
}

/// The ratio along the field distinguishes prolate from oblate shapes; without a field it is no number, and the other
/// is kept.
void choose_aspect_ratio(std::vector<HistoryCurve>& curves) {
  if (curves.size() < 2) return;
  const std::vector<double>& along_field = curves.front().values;
  const bool has_field = std::ranges::any_of(along_field, [](double ratio) { return ratio > 0.0; });
  curves.erase(has_field ? curves.begin() + 1 : curves.begin());
}

bool drifts_matter(const HistoryTable& history) {
  return std::ranges::any_of(least_drifts, [&](const LeastDrift& drift) {
    return history.has(drift.column) && history.largest_magnitude(drift.column) >= drift.least;
  });
}

}  // namespace

std::vector<HistoryQuantity> history_quantities(const Scene& scene, const HistoryTable& history,
                                                const HistoryTable* errors) {
  std::vector<HistoryQuantity> quantities;
  for (const QuantityRow& row : quantity_rows()) {
    if (!applies(row.shown, scene)) continue;
    HistoryQuantity found{.label = std::string(row.label), .is_logarithmic = row.is_logarithmic};
    for (const ColumnRow& column : row.columns) {
      // Files of earlier versions lack some columns.
      if (!history.has(column.column)) continue;
      std::vector<double> values = history.column(column.column);
      if (column.column == std::string_view(step_size)) values = sizes_of_steps(std::move(values));
      found.unit = history.unit(column.column);
      found.curves.push_back({column.label, row.is_logarithmic ? magnitudes(values) : values});
      if (errors != nullptr && !row.is_logarithmic && errors->has(column.column)) {
        found.curves.back().errors = errors->column(column.column);
        found.curves.back().errors.resize(values.size(), std::numeric_limits<double>::quiet_NaN());
      }
    }
    if (row.label == shown_quantity::aspect) choose_aspect_ratio(found.curves);
    std::erase_if(found.curves, [](const HistoryCurve& curve) { return !has_numbers(curve.values); });
    if (!found.curves.empty()) quantities.push_back(std::move(found));
  }
  return quantities;
}

std::vector<HistoryPanel> panels_of(const Scene& scene, const HistoryTable& history, const HistoryTable* errors) {
  const std::vector<HistoryQuantity> all = history_quantities(scene, history, errors);
  std::vector<HistoryPanel> panels;
  const auto add = [&](std::initializer_list<std::string_view> labels) {
    HistoryPanel panel;
    for (const std::string_view label : labels) {
      const auto found = std::ranges::find(all, label, &HistoryQuantity::label);
      if (found != all.end()) panel.axes.push_back(*found);
    }
    // With two axes, only one curve for each can be told apart.
    if (labels.size() > 1) {
      for (HistoryQuantity& axis : panel.axes) axis.curves.resize(1);
    }
    if (!panel.axes.empty()) panels.push_back(std::move(panel));
  };
  add({shown_quantity::energy, shown_quantity::tension});
  // Several vesicles have no common charge density.
  if (history.has("smallest_gap")) {
    add({shown_quantity::gap, shown_quantity::potential});
    add({shown_quantity::viscosity});
  } else {
    add({shown_quantity::potential, shown_quantity::charge});
  }
  add({shown_quantity::poration});
  add({shown_quantity::pores});
  add({shown_quantity::inclination, shown_quantity::aspect});
  add({shown_quantity::centroid});
  if (drifts_matter(history)) add({shown_quantity::errors});
  // Panels form two columns: fills the last row.
  if (panels.size() % 2 == 1) add({shown_quantity::extent});
  return panels;
}

HistoryCurve envelope_of_oscillation(HistoryCurve curve) {
  constexpr std::size_t most_turns = 60, places = 400;
  const std::vector<double> values = curve.values;
  const std::size_t n = values.size();
  const std::size_t n_turns = turns_of(values);
  if (n_turns <= most_turns || !curve.errors.empty()) return curve;
  // A period has two turning points.
  const std::size_t period = 2 * n / n_turns + 1, stride = std::max<std::size_t>(1, n / places);
  curve.errors.resize(n);
  curve.is_envelope = true;
  for (std::size_t i = 0; i < n; i += stride) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    // Near the ends the nearest whole period is taken, since the middle of a part of one depends on its phase.
    const std::size_t start = std::min(i - std::min(i, period / 2), n - std::min(n, period + 1));
    for (std::size_t j = start; j < std::min(n, start + period + 1); ++j) {
      if (!std::isfinite(values[j])) continue;
      least = std::min(least, values[j]);
      most = std::max(most, values[j]);
    }
    for (std::size_t j = i; j < std::min(n, i + stride); ++j) {
      curve.values[j] = 0.5 * (least + most);
      curve.errors[j] = 0.5 * (most - least);
    }
  }
  return curve;
}

bool changes_at_the_start(std::span<const HistoryPanel> panels, const std::vector<double>& times) {
  constexpr double start = 0.05, most_of_a_change = 0.9;
  double end_of_changes = 0.0;
  for (const HistoryPanel& panel : panels) {
    for (const HistoryQuantity& axis : panel.axes) {
      for (const HistoryCurve& curve : axis.curves) {
        std::vector<double> variation = {0.0};
        for (std::size_t i = 1; i < curve.values.size(); ++i) {
          const double change = std::abs(curve.values[i] - curve.values[i - 1]);
          variation.push_back(variation.back() + (std::isfinite(change) ? change : 0.0));
        }
        const auto row = std::ranges::lower_bound(variation, most_of_a_change * variation.back());
        end_of_changes = std::max(end_of_changes, times[static_cast<std::size_t>(row - variation.begin())]);
      }
    }
  }
  return end_of_changes > 0.0 && end_of_changes < start * times.back();
}

std::vector<std::size_t> rows_to_draw(std::span<const HistoryCurve> curves, std::size_t n_stretches) {
  const std::size_t n = curves.front().values.size();
  const std::size_t length = std::max<std::size_t>(1, n / n_stretches);
  std::set<std::size_t> rows = {0, n - 1};
  for (std::size_t start = 0; start < n; start += length) {
    for (const HistoryCurve& curve : curves) {
      const std::vector<double>& values = curve.values;
      std::size_t least = start, most = start;
      for (std::size_t i = start; i < std::min(n, start + length); ++i) {
        // A number replaces NaN.
        if (values[i] < values[least] || std::isnan(values[least])) least = i;
        if (values[i] > values[most] || std::isnan(values[most])) most = i;
      }
      rows.insert({least, most});
    }
  }
  return {rows.begin(), rows.end()};
}

}  // namespace vehd
