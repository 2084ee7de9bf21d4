#include "bie/bench/picture.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>

#include "bie/pictures/gnuplot.hpp"

namespace vehd {
namespace {

constexpr std::array colours{"#1f5fa8", "#c0392b", "#2c8a3d", "#8e44ad", "#d68910", "#17767d", "#555555", "#b03a7a"};
/// Filled markers; the one before each is its outline.
constexpr std::array markers{7, 5, 9, 13, 11, 15, 7, 5};
constexpr int panel_width = 900, panel_height = 760;

std::string value_of(const BenchCurve& curve, const std::string& column) {
  const std::string value = fmt::format("column('{}')", column);
  if (curve.key.empty()) return fmt::format("({})", value);
  return fmt::format("(strcol('{}') eq '{}' ? {} : NaN)", curve.key, curve.value, value);
}

std::string line_of(const BenchCurve& curve, const std::string& data) {
  const std::size_t style = static_cast<std::size_t>(curve.colour) % colours.size();
  std::string line =
      fmt::format("{} using {}:{} with linespoints lw {} {} pt {} ps 1.6 lc rgb '{}' title {}", gnuplot_quoted(data),
                  value_of(curve, curve.x), value_of(curve, curve.y), curve.dashed ? 1.5 : 3.0,
                  curve.dashed ? "dashtype (8,6)" : "dashtype solid",
                  curve.dashed ? markers[style] - 1 : markers[style], colours[style], gnuplot_quoted(curve.label));
  if (curve.note.empty()) return line;
  return line + fmt::format(", {} using {}:{}:(strcol('{}')) with labels offset 1.6,0.6 font ',13' notitle",
                            gnuplot_quoted(data), value_of(curve, curve.x), value_of(curve, curve.y), curve.note);
}

std::string script_of(const BenchPanel& panel, const std::string& data) {
  std::string script = fmt::format("set xlabel {}\nset ylabel {} offset 0.5,0\n", gnuplot_quoted(panel.x_label),
                                   gnuplot_quoted(panel.y_label));
  script += panel.straight_x ? "unset logscale x; set format x '%g'\n" : "set logscale x; set format x '10^{%L}'\n";
  if (panel.x_ticks.empty()) {
    script += "set xrange [*:*]; set xtics auto\n";
  } else {
    constexpr double kMargin = 1.25;
    script += fmt::format("set xrange [{}:{}]; set xtics ({}); set format x '%g'\n", panel.x_ticks.front() / kMargin,
                          panel.x_ticks.back() * kMargin, fmt::join(panel.x_ticks, ", "));
  }
  script += panel.key_place.empty() ? "unset key\n"
                                    : fmt::format("set key {} spacing 1.15 font ',15' samplen 2.5\n", panel.key_place);
  std::string plot;
  for (const BenchCurve& curve : panel.curves) plot += (plot.empty() ? "plot " : ", ") + line_of(curve, data);
  return script + plot + "\n";
}

}  // namespace

void draw_bench(const std::filesystem::path& csv, const std::vector<BenchPanel>& panels,
                const std::filesystem::path& picture) {
  const int width = panel_width * static_cast<int>(panels.size());
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} enhanced font 'Sans,19' background rgb 'white'\n"
      "set output {}\n"
      "set multiplot layout 1,{}\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set logscale y; set format y '10^{{%L}}'\n"
      "set border lw 1.2\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lt 1 lw 1\n"
      "set offsets graph 0.03, graph 0.06, 0, 0\n",
      width, panel_height, gnuplot_quoted(std::filesystem::absolute(picture).string()), panels.size());
  const std::string data = std::filesystem::absolute(csv).string();
  for (const BenchPanel& panel : panels) script += script_of(panel, data);
  run_gnuplot(script + "unset multiplot\n", picture.parent_path());
}

}  // namespace vehd
