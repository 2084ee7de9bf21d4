#pragma once

#include <span>
#include <string>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// One line against time.
struct HistoryCurve {
  std::string label;
  std::vector<double> values;    ///< one for each row, NaN if there is none
  std::vector<double> errors{};  ///< estimates, one for each row; empty without error bars
  bool is_envelope = false;      ///< values ± errors are the bounds of an oscillation
};

/// Curves that share an axis.
struct HistoryQuantity {
  std::string label;
  std::string unit{};  ///< symbol in the file; empty: dimensionless
  std::vector<HistoryCurve> curves{};
  bool is_logarithmic = false;  ///< values are magnitudes; zeros are NaN
};

/// Significant columns of a run, in this order: energy; tension; V_m and charge with a field; the inclination in a
/// flow; the aspect ratio, along the field if there is one; the centroid of a vesicle that settles or swims; the
/// errors; the extents; step and degree if a tolerance chooses them. Curves with fewer than two numbers are left out,
/// as are quantities without curves.
/// @param errors  estimates for the history, possibly of fewer rows; null without error bars
std::vector<HistoryQuantity> history_quantities(const Scene& scene, const HistoryTable& history,
                                                const HistoryTable* errors = nullptr);

/// Part of a picture: one quantity with all its curves, or two with an axis at either side and their first curves.
struct HistoryPanel {
  std::vector<HistoryQuantity> axes;
};

/// Panels of the quantities that fit in one picture: energy and tension, V_m and charge, inclination and aspect ratio;
/// the errors if a drift comes near the limit of the verdict; the extents if the page has room for them.
/// @param errors  see history_quantities
std::vector<HistoryPanel> panels_of(const Scene& scene, const HistoryTable& history,
                                    const HistoryTable* errors = nullptr);

/// Replaces a curve with more than 60 turning points, rounding apart, which would fill its panel, by its
/// envelope, the minimum and maximum of each period. Any other curve is returned unchanged.
HistoryCurve envelope_of_oscillation(HistoryCurve curve);

/// Do all curves complete nine tenths of their changes within the first twentieth of the time? Then a logarithmic axis
/// of time shows them.
/// @param times   ascending, one for each value of the curves
bool changes_at_the_start(std::span<const HistoryPanel> panels, const std::vector<double>& times);

/// Rows that represent all in a drawing: the minima and maxima of the curves in each of n_stretches parts, so that no
/// peak is lost, and the first and the last row.
/// @param curves  of one length
std::vector<std::size_t> rows_to_draw(std::span<const HistoryCurve> curves, std::size_t n_stretches);

}  // namespace vehd
