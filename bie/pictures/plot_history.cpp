#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/history_panels.hpp"
#include "bie/pictures/page.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/runs/run_files.hpp"
#include "bie/scene/output_units.hpp"

namespace vehd {
namespace {

constexpr std::array curve_colours = {"#1f5fa8", "#2c8a3d", "#c0392b", "#7a7a7a"};
constexpr std::array dashes = {"solid", "(12,6)", "(3,4)", "(12,4,3,4)"};
/// Size of one panel with its texts, in points.
constexpr double panel_width = 255.0, panel_height = 172.0;
/// Margins around the axes of a panel.
constexpr double panel_left = 52.0, panel_right = 52.0, panel_bottom = 32.0, panel_top = 18.0;
constexpr double letter_size = 8.0;
constexpr double curve_width = 1.3;
/// Of a long curve the least and the greatest value of each of these stretches are drawn.
constexpr std::size_t picture_stretches = 1500;

struct Axis {
  double lower = 0.0, upper = 1.0;
  std::string ticks;  ///< in the syntax of gnuplot
  std::string label;
  std::vector<std::string> texts;  ///< of the ticks
  bool is_logarithmic = false;
};

/// The ends of the error band, or the values if there is none.
std::vector<double> reach_of_curve(const HistoryCurve& curve) {
  std::vector<double> reach = curve.values;
  for (std::size_t i = 0; i < curve.errors.size(); ++i) {
    reach[i] -= curve.errors[i];
    reach.push_back(curve.values[i] + curve.errors[i]);
  }
  return reach;
}

Axis axis_of(const std::vector<double>& values, const std::string& label, double room) {
  auto [lower, upper] = finite_range(values);
  const double about = room_around_constant(lower, upper);
  lower -= about;
  upper += about;
  Axis axis{lower - room * (upper - lower), upper + room * (upper - lower), {}, label, {}};
  const std::vector<double> ticks = round_ticks(axis.lower, axis.upper, 4);
  int power = 0;
  axis.texts = tick_texts(ticks, power);
  axis.ticks = gnuplot_ticks(axis.texts, ticks);
  if (power != 0) axis.label += fmt::format(" / 10^{{{}}}", power);
  return axis;
}

/// For gnuplot: ('0.1' 1e-1, '1' 1e0).
std::string ticks_at_powers(const std::vector<int>& powers) {
  const std::vector<std::string> texts = power_texts(powers);
  std::vector<std::string> places;
  for (std::size_t i = 0; i < powers.size(); ++i) places.push_back(fmt::format("'{}' 1e{}", texts[i], powers[i]));
  return fmt::format("({})", fmt::join(places, ", "));
}

Axis axis_of_time(const std::vector<double>& times, const std::string& label, bool is_logarithmic) {
  if (!is_logarithmic) return axis_of(times, label, 0.0);
  const auto first = std::ranges::find_if(times, [](double time) { return time > 0.0; });
  Axis axis{*first, times.back(), {}, label, {}, true};
  std::vector<int> powers;
  for (int power = static_cast<int>(std::ceil(std::log10(axis.lower)));
       power <= static_cast<int>(std::floor(std::log10(axis.upper) + 1e-9)); ++power) {
    powers.push_back(power);
  }
  axis.ticks = ticks_at_powers(powers);
  return axis;
}

/// Data of a curve and of its error band; the line is interrupted where the angle of an axis wraps around.
std::string data_block(int number, const std::vector<double>& times, const HistoryCurve& curve, double half_turn) {
  const std::vector<double>& values = curve.values;
  std::string block = fmt::format("$curve{} << END\n", number);
  double before = values.front();
  for (const std::size_t row : rows_to_draw({&curve, 1}, picture_stretches)) {
    if (half_turn > 0.0 && std::abs(values[row] - before) > half_turn) block += "\n";
    before = values[row];
    block += fmt::format("{:.9g} {:.9g}", times[row], values[row]);
    if (!curve.errors.empty()) {
      block += fmt::format(" {:.9g} {:.9g}", values[row] - curve.errors[row], values[row] + curve.errors[row]);
    }
    block += "\n";
  }
  return block + "END\n";
}

struct Drawing {
  const std::vector<double>& times;
  PictureFormat format;
  int n_curves = 0;  ///< so far

  [[nodiscard]] std::string line_style(std::size_t curve) const {
    return fmt::format("with lines lw {:.3g} dashtype {} lc rgb '{}'", gnuplot_line_width(format, curve_width, pixels),
                       dashes[curve], curve_colours[curve]);
  }

  /// A curve with its error band, or both lines of an envelope.
  [[nodiscard]] std::string plot(const HistoryCurve& curve, std::size_t colour, const char* axes,
                                 const std::string& title) const {
    const std::string line = fmt::format("{} axes {}", line_style(colour), axes);
    if (curve.is_envelope) {
      return fmt::format("$curve{0} using 1:3 {1} {2}, $curve{0} using 1:4 {1} notitle", n_curves, line, title);
    }
    const std::string band =
        curve.errors.empty()
            ? std::string()
            : fmt::format(
                  "$curve{} using 1:3:4 with filledcurves fillstyle transparent solid 0.25 noborder lc rgb '{}' "
                  "axes {} notitle, ",
                  n_curves, curve_colours[colour], axes);
    return fmt::format("{}$curve{} using 1:2 {} {}", band, n_curves, line, title);
  }

  static constexpr double pixels = 4.0;
};

/// Ticks of an axis and its label beside them: gnuplot would derive the room for the label from the bytes of the ticks.
std::string axis_script(const Axis& axis, const char* name, const char* colour) {
  constexpr double axes_width = panel_width - panel_left - panel_right;
  double ticks_width = 0.0;
  for (const std::string& text : axis.texts) ticks_width = std::max(ticks_width, letter_size * text_width(text));
  const bool on_the_right = std::string_view(name) == "y2";
  const double away = (ticks_width + 6.5 + 0.75 * letter_size) / axes_width;
  return fmt::format(
      "set {0}range [{1:.12g}:{2:.12g}]; set {0}tics {3} nomirror textcolor rgb '{4}'\n"
      "set label {5} at graph {6:.5f},0.5 center rotate by 90 textcolor rgb '{4}'\n",
      name, axis.lower, axis.upper, axis.ticks, colour, gnuplot_quoted(axis.label), on_the_right ? 1.0 + away : -away);
}

constexpr const char* panel_reset =
    "unset label; unset ytics; unset y2tics; unset logscale y; unset key; set format y '%g'\n";
constexpr const char* key_above =
    "set key at graph 0.5,1.075 center center horizontal samplen 1.4 width -1.5 maxrows 1\n";

std::string panel_of_own_axes(const HistoryPanel& panel, Drawing& drawing) {
  std::string data, settings = panel_reset, plot;
  for (std::size_t i = 0; i < panel.axes.size(); ++i) {
    const HistoryCurve& curve = panel.axes[i].curves.front();
    settings += axis_script(axis_of(reach_of_curve(curve), with_unit(curve.label, panel.axes[i].unit), 0.06),
                            i == 0 ? "y" : "y2", curve_colours[i]);
    constexpr double half_turn = 90.0;
    data +=
        data_block(drawing.n_curves, drawing.times, curve, curve.label.starts_with("inclination") ? half_turn : 0.0);
    plot += (i == 0 ? "plot " : ", ") + drawing.plot(curve, i, i == 0 ? "x1y1" : "x1y2", "notitle");
    ++drawing.n_curves;
  }
  return data + settings + plot + "\n";
}

/// Axis of whole powers of ten; values far below the largest are cut off.
std::string logarithmic_axis(const std::vector<HistoryCurve>& curves, const std::string& label) {
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const HistoryCurve& curve : curves) {
    for (const double value : curve.values) {
      if (!(value > 0.0)) continue;
      least = std::min(least, value);
      most = std::max(most, value);
    }
  }
  constexpr double shown_powers = 9.0, fewest_powers = 2.0;
  const double upper = std::ceil(std::log10(most) + 1e-9);
  const double lower = std::clamp(std::floor(std::log10(least)), upper - shown_powers, upper - fewest_powers);
  std::vector<int> powers;
  Axis axis{std::pow(10.0, lower), std::pow(10.0, upper), {}, label, {}};
  for (double power = upper; power >= lower; power -= upper - lower > 5.0 ? 2.0 : 1.0) {
    powers.push_back(static_cast<int>(power));
    // Sets the width: the printed power is smaller.
    axis.texts.push_back("1e-12");
  }
  axis.ticks = ticks_at_powers(powers);
  return "set logscale y\n" + axis_script(axis, "y", "#000000");
}

std::string panel_of_common_axis(const HistoryQuantity& quantity, Drawing& drawing) {
  std::vector<double> all;
  std::string data, plot;
  for (std::size_t i = 0; i < quantity.curves.size(); ++i) {
    const HistoryCurve& curve = quantity.curves[i];
    const std::vector<double> reach = reach_of_curve(curve);
    all.insert(all.end(), reach.begin(), reach.end());
    data += data_block(drawing.n_curves, drawing.times, curve, 0.0);
    plot += (i == 0 ? "plot " : ", ") + drawing.plot(curve, i, "x1y1", "title " + gnuplot_quoted(curve.label));
    ++drawing.n_curves;
  }
  const std::string label = with_unit(quantity.label, quantity.unit);
  const std::string axis = quantity.is_logarithmic ? logarithmic_axis(quantity.curves, label)
                                                   : axis_script(axis_of(all, label, 0.06), "y", "#000000");
  return data + panel_reset + key_above + axis + plot + "\n";
}

}  // namespace

bool plot_history(const PlotTask& task, const PictureFile& file) {
  ReadingNotes notes;
  const Scene scene = read_scene_of(read_snapshots(task.paths.snapshots(), notes));
  const HistoryTable history = read_table(task.paths.history(), notes);
  std::optional<HistoryTable> errors;
  if (scene.numerics.error_bars) errors.emplace(read_table(task.paths.history_error(), notes));
  std::vector<HistoryPanel> panels = panels_of(scene, history, errors ? &*errors : nullptr);
  if (panels.empty()) return false;
  for (HistoryPanel& panel : panels) {
    for (HistoryQuantity& axis : panel.axes) {
      if (axis.is_logarithmic) continue;
      for (HistoryCurve& curve : axis.curves) curve = envelope_of_oscillation(std::move(curve));
    }
  }
  const std::vector<double>& times = history.column("time");
  const Axis time_axis =
      axis_of_time(times, with_unit("time", history.unit("time")), changes_at_the_start(panels, times));

  const int columns = panels.size() > 1 ? 2 : 1, rows = (static_cast<int>(panels.size()) + columns - 1) / columns;
  const double width = columns * panel_width, height = rows * panel_height;
  std::string script = gnuplot_terminal(file.format, {width, height, letter_size, Drawing::pixels});
  script += fmt::format(
      "set multiplot\n"
      "set border lw {0:.3g}\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lt 1 lw {0:.3g}\n"
      "set tics scale 0.6; set mytics 1\n"
      "set xrange [{1:.12g}:{2:.12g}]; set xtics {3} nomirror; set xlabel {4} offset 0,0.4\n{5}",
      gnuplot_line_width(file.format, 0.5, Drawing::pixels), time_axis.lower, time_axis.upper, time_axis.ticks,
      gnuplot_quoted(time_axis.label), time_axis.is_logarithmic ? "set logscale x\n" : "");
  Drawing drawing{times, file.format};
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double left = panel_width * static_cast<double>(i % static_cast<std::size_t>(columns));
    const double top = height - panel_height * static_cast<double>(i / static_cast<std::size_t>(columns));
    script += fmt::format(
        "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}; set bmargin at screen {:.5f}; set tmargin at "
        "screen "
        "{:.5f}\n",
        (left + panel_left) / width, (left + panel_width - panel_right) / width,
        (top - panel_height + panel_bottom) / height, (top - panel_top) / height);
    const std::vector<HistoryQuantity>& axes = panels[i].axes;
    const bool is_shared = axes.size() == 1 && (axes.front().curves.size() > 1 || axes.front().is_logarithmic);
    script += is_shared ? panel_of_common_axis(axes.front(), drawing) : panel_of_own_axes(panels[i], drawing);
  }
  draw_with_gnuplot(script + "unset multiplot\n", file);
  return true;
}

}  // namespace vehd
