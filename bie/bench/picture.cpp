#include "bie/bench/picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/shown_numbers.hpp"

namespace vehd {
namespace {

constexpr std::array colours{"#1f5fa8", "#c0392b", "#2c8a3d", "#8e44ad", "#d68910", "#17767d", "#555555", "#b03a7a"};
/// Filled markers of gnuplot; the number before each is its outline.
constexpr std::array markers{7, 5, 9, 13, 11, 15, 7, 5};
/// In points: size of one panel with its texts, and margins around its axes.
constexpr double panel_width = 240.0, panel_height = 205.0;
constexpr double around_left = 46.0, around_right = 8.0, around_bottom = 32.0, around_top = 8.0;
/// Names of groups may have two lines.
constexpr double around_bottom_of_bars = 46.0;
constexpr double letters = 8.0, note_letters = 6.5;
constexpr double pixels = 4.0;

double line_width(double points) { return gnuplot_line_width(PictureFormat::png, points, pixels); }
double font_size(double points) { return gnuplot_font_size(PictureFormat::png, points, pixels); }

std::string style_of(const BenchCurve& curve) {
  const std::size_t style = static_cast<std::size_t>(curve.colour) % colours.size();
  if (curve.kind == CurveKind::wide) {
    return fmt::format("with lines lw {:.3g} lc rgb '#60{}'", line_width(5.0), colours[style] + 1);
  }
  const bool dashed = curve.kind == CurveKind::dashed;
  // Dashes distinguish curves whose colours repeat.
  const bool again = static_cast<std::size_t>(curve.colour) / colours.size() % 2 == 1;
  const char* dashes = dashed ? "(8,6)" : again ? "(4,6)" : "solid";
  return fmt::format("with linespoints lw {:.3g} dashtype {} pt {} ps {:.3g} lc rgb '{}'",
                     line_width(dashed ? 0.8 : 1.3), dashes, markers[style] - (dashed || again ? 1 : 0), 2.2,
                     colours[style]);
}

std::string block(int number, const std::vector<double>& x, const std::vector<double>& y) {
  std::string text = fmt::format("$data{} << END\n", number);
  for (std::size_t i = 0; i < x.size(); ++i) text += fmt::format("{:.9g} {:.9g}\n", x[i], y[i]);
  return text + "END\n";
}

/// The parts of a script that all panels share.
struct BenchScript {
  std::string text;
  int n_blocks = 0;
  std::vector<std::string> in_key;  ///< labels that it already has

  bool is_new(const std::string& label) {
    if (std::ranges::find(in_key, label) != in_key.end()) return false;
    in_key.push_back(label);
    return true;
  }
};

/// Of ticks at powers of ten: decimals between 0.1 and 1000.
const char* power_format(const PlotScale& axis) { return axis.lower > 0.01 && axis.upper < 1e4 ? "%g" : "10^{%L}"; }

std::string range_script(const BenchPanel& panel, const PlotAxes& axes) {
  std::string script = panel.straight_x ? "unset logscale x; set format x '%g'\n"
                                        : fmt::format("set logscale x; set format x '{}'\n", power_format(axes.x));
  script += fmt::format("set xrange [{:.9g}:{:.9g}]; set yrange [{:.9g}:{:.9g}]\n", axes.x.lower, axes.x.upper,
                        axes.y.lower, axes.y.upper);
  script += panel.x_ticks.empty() ? std::string("set xtics autofreq\n")
                                  : fmt::format("set xtics ({}); set format x '%g'\n", fmt::join(panel.x_ticks, ", "));
  return script + fmt::format("set logscale y; set format y '{}'; set ytics autofreq\n", power_format(axes.y));
}

void add_curves(const BenchPanel& panel, BenchScript& script) {
  const PlotAxes axes =
      axes_of(panel, panel_width - around_left - around_right, panel_height - around_bottom - around_top);
  script.text += range_script(panel, axes);
  std::string plot;
  for (const BenchSlope& slope : panel.slopes) {
    const double y_to = slope.y_from * std::pow(slope.x_to / slope.x_from, slope.exponent);
    script.text += block(script.n_blocks, {slope.x_from, slope.x_to}, {slope.y_from, y_to});
    plot += fmt::format("$data{} using 1:2 with lines lw {:.3g} lc rgb '#999999' notitle, ", script.n_blocks++,
                        line_width(0.7));
  }
  // Wide curves first, so that the others are drawn over them.
  for (const bool wide : {true, false}) {
    for (const BenchCurve& curve : panel.curves) {
      if ((curve.kind == CurveKind::wide) != wide) continue;
      script.text += block(script.n_blocks, curve.x, curve.y);
      const std::string title =
          script.is_new(curve.label) ? "title " + gnuplot_quoted(curve.label) : std::string("notitle");
      plot += fmt::format("$data{} using 1:2 {} {}, ", script.n_blocks++, style_of(curve), title);
    }
  }
  script.text += "unset label\n";
  for (const PlacedNote& note : place_notes(panel, axes, note_letters)) {
    script.text += fmt::format(
        "set label {} at graph {:.5f},{:.5f} center front font ',{:.4g}' textcolor rgb '{}'\n",
        gnuplot_quoted(note.text), note.at[0] / axes.x.length, note.at[1] / axes.y.length, font_size(note_letters),
        note.colour < 0 ? "#777777" : colours[static_cast<std::size_t>(note.colour) % colours.size()]);
  }
  script.text += "plot " + plot + "NaN notitle\n";
}

void add_bars(const BenchPanel& panel, BenchScript& script) {
  const BenchBars& bars = panel.bars;
  double most = 0.0;
  for (const auto& group : bars.values) most = std::max(most, *std::ranges::max_element(group));
  const double top = 1.15 * most;
  const std::vector<double> ticks = round_ticks(0.0, top, 4);
  int power = 0;
  const std::vector<std::string> texts = tick_texts(ticks, power);
  const std::string label = power == 0 ? panel.y_label : fmt::format("{} / 10^{{{}}}", panel.y_label, power);
  // One word per line.
  std::vector<std::string> names = bars.groups;
  std::vector<double> middles;
  for (std::string& name : names) {
    std::ranges::replace(name, ' ', '\n');
    middles.push_back(static_cast<double>(middles.size()));
  }
  script.text += fmt::format("set bmargin at screen {:.5f}\n", around_bottom_of_bars / panel_height);
  script.text += fmt::format(
      "unset logscale; unset label; set xrange [-0.5:{}-0.5]; set yrange [0:{:.9g}]; set ytics {}; set ylabel {}\n"
      "set xlabel {} offset 0,-0.7; set xtics {} scale 0 offset 0,0.3; unset grid; set grid ytics lc rgb '#e4e4e4' "
      "lt 1\n",
      bars.groups.size(), top, gnuplot_ticks(texts, ticks), gnuplot_quoted(label), gnuplot_quoted(panel.x_label),
      gnuplot_ticks(names, middles));
  const double width = 0.8 / static_cast<double>(bars.bars.size());
  std::string plot;
  for (std::size_t k = 0; k < bars.bars.size(); ++k) {
    std::vector<double> x, y;
    for (std::size_t i = 0; i < bars.groups.size(); ++i) {
      x.push_back(static_cast<double>(i) + (static_cast<double>(k) + 0.5) * width - 0.4);
      y.push_back(bars.values[i][k]);
    }
    script.text += block(script.n_blocks, x, y);
    plot += fmt::format("$data{} using 1:2:({:.4f}) with boxes fill solid noborder lc rgb '{}' title {}, ",
                        script.n_blocks++, 0.92 * width, colours[k % colours.size()], gnuplot_quoted(bars.bars[k]));
  }
  for (std::size_t i = 0; i < bars.notes.size(); ++i) {
    const double highest = *std::ranges::max_element(bars.values[i]);
    script.text += fmt::format("set label {} at first {},{:.9g} center front offset 0,0.7 font ',{:.4g}'\n",
                               gnuplot_quoted(bars.notes[i]), i, highest, font_size(letters));
  }
  script.text += "plot " + plot + "NaN notitle\n";
}

/// Width of the column with the key.
double key_width_of(const std::vector<BenchPanel>& panels) {
  constexpr double sample = 26.0;
  double width = 0.0;
  for (const BenchPanel& panel : panels) {
    for (const BenchCurve& curve : panel.curves) width = std::max(width, letters * text_width(curve.label));
    for (const std::string& bar : panel.bars.bars) width = std::max(width, letters * text_width(bar));
  }
  return width + sample;
}

}  // namespace

BenchSlope slope_beside(const BenchCurve& curve, double exponent, const std::string& label, double factor,
                        std::size_t n_points) {
  BenchSlope slope{label, exponent};
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < curve.x.size(); ++i) {
    if (curve.y[i] > 0.0) known.push_back(i);
  }
  if (known.empty()) return slope;
  const std::size_t first = known.size() > n_points ? known[known.size() - n_points] : known.front();
  const std::size_t last = known.back();
  slope.x_from = curve.x[first];
  slope.x_to = curve.x[last];
  const double y_to = factor * curve.y[last];
  slope.y_from = y_to * std::pow(slope.x_from / slope.x_to, exponent);
  return slope;
}

void draw_bench(const std::vector<BenchPanel>& panels, const std::filesystem::path& picture) {
  const bool has_bars = !panels.front().bars.groups.empty();
  // Names of groups need more room than numbers do.
  const double one = has_bars ? 1.6 * panel_width : panel_width;
  const double width = std::ceil(one * static_cast<double>(panels.size()) + key_width_of(panels));
  BenchScript script;
  script.text = gnuplot_terminal(PictureFormat::png, {width, panel_height, letters, pixels});
  script.text += fmt::format(
      "set multiplot\n"
      "set border lw {0:.3g}; set tics scale 0.6; unset key\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lt 1 lw {0:.3g}\n"
      "set bmargin at screen {1:.5f}; set tmargin at screen {2:.5f}\n",
      line_width(0.5), around_bottom / panel_height, 1.0 - around_top / panel_height);
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double left = one * static_cast<double>(i);
    script.text += fmt::format(
        "set lmargin at screen {:.5f}; set rmargin at screen {:.5f}\nset xlabel {} offset 0,0.4\nset ylabel {}\n",
        (left + around_left) / width, (left + one - around_right) / width, gnuplot_quoted(panels[i].x_label),
        gnuplot_quoted(panels[i].y_label));
    // Each panel adds the labels that the panels before it lack; all are in the order of the first panel.
    script.text += fmt::format("set key at screen {:.5f},{:.5f} left top Left reverse samplen 1.6 spacing 1.2\n",
                               (one * static_cast<double>(panels.size()) - around_right + 6.0) / width,
                               1.0 - (around_top + 13.0 * static_cast<double>(script.in_key.size())) / panel_height);
    has_bars ? add_bars(panels[i], script) : add_curves(panels[i], script);
  }
  draw_with_gnuplot(script.text + "unset multiplot\n", {picture, PictureFormat::png});
}

}  // namespace vehd
