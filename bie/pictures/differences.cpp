#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/plots.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {
namespace {

constexpr int difference_width = 620;
constexpr int difference_height = 560;
constexpr int coordinates = 3;
constexpr const char* data_name = "differences.dat";

/// Names of the columns, from the first line "# x y z q …".
std::vector<std::string> columns_of(const std::filesystem::path& data) {
  std::ifstream file(data);
  std::string line, word;
  std::getline(file, line);
  std::istringstream words(line);
  std::vector<std::string> columns;
  words >> word;
  while (words >> word) columns.push_back(word);
  if (columns.size() <= coordinates) throw InputError(fmt::format("{}: names no field", data.string()));
  return columns;
}

std::string title_of(const std::string& column) {
  if (column == "Vm") return "V_m, steady";
  if (column == "force") return "f_E";
  if (column == "velocity") return "v";
  return column;
}

/// Equal ranges on the three axes: gnuplot fits a cube into its panel, but not every box.
std::string cube_around() {
  std::string script = "half = 0\n";
  const std::string axes = "xyz";
  for (std::size_t i = 0; i < axes.size(); ++i) {
    script += fmt::format(
        "stats '{0}' using {1} name '{2}' nooutput\nhalf = {2}_max - {2}_min > 2*half ? 0.5*({2}_max - "
        "{2}_min) : half\n",
        data_name, i + 1, axes[i]);
  }
  for (const char axis : axes) {
    script += fmt::format("set {0}range [0.5*({0}_min + {0}_max) - half : 0.5*({0}_min + {0}_max) + half]\n", axis);
  }
  return script;
}

}  // namespace

std::filesystem::path differences_file(const std::filesystem::path& directory) { return directory / data_name; }

bool draw_differences(const std::filesystem::path& directory) {
  const std::filesystem::path data = differences_file(directory);
  if (!std::filesystem::exists(data)) return false;
  const std::vector<std::string> columns = columns_of(data);
  const auto n_fields = static_cast<int>(columns.size()) - coordinates;
  const int across = n_fields > 1 ? 2 : 1;
  const int down = (n_fields + across - 1) / across;
  const PictureSize size{static_cast<double>(across * difference_width), static_cast<double>(down * difference_height),
                         16.0 / 0.75, 1.0};
  std::string script = gnuplot_terminal(PictureFormat::png, size);
  script +=
      "set pm3d depthorder; unset key; set view 70,35,1.7; set view equal xyz; set xyplane at 0\n"
      "unset border; unset tics; set colorbox\n"
      "set cbtics in 1; set format cb '%g'\n"
      "set palette defined (0 '#440154', 1 '#3b528b', 2 '#21918c', 3 '#5ec962', 4 '#fde725')\n";
  script += cube_around();
  script +=
      fmt::format("set multiplot layout {},{} title 'log_{{10}} of |FEM − BIE| over the largest value of the field'\n",
                  down, across);
  for (int i = 0; i < n_fields; ++i) {
    script += fmt::format("set title {}\nsplot '{}' using 1:2:3:{} with pm3d\n",
                          gnuplot_quoted(title_of(columns[coordinates + i])), data_name, coordinates + i + 1);
  }
  draw_with_gnuplot(script + "unset multiplot\n", {directory / "differences.png", PictureFormat::png},
                    {{data_name, text_of_file(data)}});
  return true;
}

}  // namespace vehd
