#include <fmt/format.h>

#include <array>

#include "bie/app/bench_methods.hpp"
#include "bie/app/gnuplot.hpp"

namespace vehd {
namespace {

constexpr std::array colours{"#1f5fa8", "#c0392b", "#2c8a3d"};
constexpr std::array markers{7, 5, 9};

struct Axis {
  const char* column;
  const char* label;
};
constexpr std::array axes{Axis{"seconds", "seconds of one core"}, Axis{"unknowns", "unknowns"}};

std::string plot_of(const Axis& axis, const std::string& data, const std::vector<MethodCurve>& curves) {
  std::string plot = "plot ";
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const bool force : {false, true}) {
      plot += fmt::format(
          "{}{} using (strcol('method') eq '{}' ? column('{}') : NaN):(column('{}')) with linespoints lw {} {} "
          "pt {} ps 1.6 lc rgb '{}' title {}",
          i == 0 && !force ? "" : ", ", gnuplot_quoted(data), curves[i].name, axis.column,
          force ? "error_force" : "error_q", force ? 1.5 : 3.0, force ? "dashtype (8,6)" : "dashtype solid",
          force ? markers[i] - 1 : markers[i], colours[i], gnuplot_quoted(curves[i].label + (force ? ": f_E" : ": q")));
    }
  }
  return plot + "\n";
}

}  // namespace

void draw_methods(const std::filesystem::path& directory, const std::vector<MethodCurve>& curves) {
  const std::string data = (directory / "methods.csv").string();
  std::string script = fmt::format(
      "set terminal pngcairo size 1800,760 enhanced font 'Sans,19' background rgb 'white'\n"
      "set output {}\n"
      "set multiplot layout 1,2\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set logscale xy\n"
      "set format x '10^{{%L}}'; set format y '10^{{%L}}'\n"
      "set border lw 1.2\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lt 1 lw 1\n"
      "unset key\n"
      "set ylabel 'relative error, L2 over the membrane' offset 0.5,0\n",
      gnuplot_quoted((directory / "methods.png").string()));
  for (const Axis& axis : axes) {
    script += fmt::format("set xlabel '{}'\n", axis.label) + plot_of(axis, data, curves);
    // Only finite elements have that many unknowns, and none of them so small an error: there the second panel is
    // empty.
    script += "set key bottom right spacing 1.15 font ',15' samplen 2.5; unset ylabel\n";
  }
  run_gnuplot(script + "unset multiplot\n", directory);
}

}  // namespace vehd
