#include <fmt/format.h>

#include <string>
#include <vector>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/runs/history.hpp"
#include "bie/scene/output_units.hpp"
#include "bie/scene/reader.hpp"

namespace vehd {
namespace {

constexpr const char* first_colour = "#1f5fa8";
constexpr const char* second_colour = "#2c8a3d";
constexpr int panel_width = 900;
constexpr int panel_height = 640;

struct Curve {
  std::string column;
  std::string label;
};

/// One or two curves against time; the second has the right axis.
struct Panel {
  std::vector<Curve> curves;
};

std::vector<Panel> panels_of(const Scene& scene) {
  std::vector<Panel> panels;
  panels.push_back({{{"bending_energy_scaled", "bending energy ∫ H^2 dγ"}, {"tension_integral", "tension ∫ λ dγ"}}});
  if (scene.electric) {
    panels.push_back({{{"Vm_north", "V_m at the north pole"}, {"q_north", "q at the north pole"}}});
  } else {
    panels.push_back({{{"extent_x", "extent along x"}, {"extent_z", "extent along z"}}});
  }
  if (scene.flow) panels.push_back({{{"inclination_deg", "inclination (degrees)"}}});
  return panels;
}

std::string panel_script(const Panel& panel, const HistoryTable& table, const std::string& history, double left,
                         double right) {
  const auto label = [&](const Curve& curve) {
    return gnuplot_quoted(with_unit(curve.label, table.unit(curve.column)));
  };
  std::string script = fmt::format(
      "set lmargin at screen {}; set rmargin at screen {}\n"
      "set ylabel {} textcolor rgb '{}' offset 0.5,0\n"
      "set ytics nomirror textcolor rgb '{}'\n",
      left, right, label(panel.curves[0]), first_colour, first_colour);
  if (panel.curves.size() > 1) {
    script += fmt::format("set y2label {} textcolor rgb '{}' offset -0.5,0\nset y2tics nomirror textcolor rgb '{}'\n",
                          label(panel.curves[1]), second_colour, second_colour);
  } else {
    script += "unset y2label; unset y2tics\n";
  }
  script +=
      fmt::format("plot {} using (column('{}')):(column('{}')) with lines lw 3 lc rgb '{}' axes x1y1",
                  gnuplot_quoted(history), table.header("time"), table.header(panel.curves[0].column), first_colour);
  if (panel.curves.size() > 1) {
    script +=
        fmt::format(", '' using (column('{}')):(column('{}')) with lines lw 3 dashtype (12,6) lc rgb '{}' axes x1y2",
                    table.header("time"), table.header(panel.curves[1].column), second_colour);
  }
  return script + "\n";
}

}  // namespace

void plot_history(const PlotTask& task, const std::filesystem::path& picture) {
  const std::vector<Panel> panels = panels_of(read_scene(task.paths.scene()));
  const HistoryTable table(task.paths.history());
  const int width = panel_width * static_cast<int>(panels.size());
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} enhanced font 'Sans,19' background rgb 'white'\n"
      "set output {}\n"
      "set multiplot\n"
      "set datafile separator ','\n"
      "set datafile columnheaders\n"
      "set key off\n"
      "set border lw 1.2\n"
      "set grid xtics ytics lc rgb '#e4e4e4' lt 1 lw 1\n"
      "set xlabel {}\n"
      "set xrange [*:*] noextend\n"
      "set offsets 0,0,graph 0.06,graph 0.06\n"
      "set bmargin at screen 0.15; set tmargin at screen 0.95\n",
      width, panel_height, gnuplot_quoted(picture.string()), gnuplot_quoted(with_unit("time", table.unit("time"))));
  for (std::size_t i = 0; i < panels.size(); ++i) {
    const double cell = 1.0 / static_cast<double>(panels.size());
    script += panel_script(panels[i], table, task.paths.history().string(), (static_cast<double>(i) + 0.165) * cell,
                           (static_cast<double>(i) + 0.83) * cell);
  }
  run_gnuplot(script + "unset multiplot\n", task.output);
}

}  // namespace vehd
