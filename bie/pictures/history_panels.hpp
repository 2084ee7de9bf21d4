#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "bie/runs/history.hpp"
#include "bie/scene/scene.hpp"

namespace vehd {

/// One quantity against time.
struct HistoryCurve {
  std::string label;
  std::string unit;            ///< symbol in the file; empty of a pure number
  std::vector<double> values;  ///< one for each row, NaN where there is none
};

/// One or two curves with an axis of their own each, or several of one axis.
struct HistoryPanel {
  std::vector<HistoryCurve> curves;
  std::string common_axis{};  ///< its label; empty: each curve has its own
  bool logarithmic = false;   ///< the common axis
};

/// What tells something of a run: energy and tension; V_m and charge with a field; the inclination in a flow; the
/// aspect ratio; the drifts where one of them comes near what the verdict allows; the extents where the page has room
/// for them. Curves that have no two numbers are left out, and panels without curves.
std::vector<HistoryPanel> panels_of(const Scene& scene, const HistoryTable& history);

/// The column "aspect_ratio"; where there is none the longest over the shortest extent along the axes x, y and z, which
/// is called so: of an inclined shape it is something else.
HistoryCurve aspect_curve(const HistoryTable& history);

}  // namespace vehd
