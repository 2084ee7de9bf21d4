#include "bie/fit/fit_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <map>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/page.hpp"
#include "bie/pictures/sweep_frame.hpp"

namespace vehd {
namespace {

constexpr const char *data_colour = "#c0392b", *model_colour = "#1f5fa8";

/// One experiment and its part of the fit.
struct Part {
  const Experiment& experiment;
  Vector model, residuals;
};

SweepAxis abscissa_axis(const Experiment& experiment) {
  const Measured& measured = experiment.measured;
  std::vector<std::string> values;
  if (measured.is_contour()) {
    for (const Datum& datum : experiment.data) values.push_back(fmt::format("{}", datum.angle_deg));
    return axis_of_values("φ (degrees)", values, false);
  }
  double least = std::numeric_limits<double>::infinity(), most = 0.0;
  for (const Datum& datum : experiment.data) {
    values.push_back(measured.abscissa_unit.empty() ? datum.at
                                                    : fmt::format("{} {}", datum.at, measured.abscissa_unit));
    const double number = std::strtod(datum.at.c_str(), nullptr);
    least = std::min(least, number);
    most = std::max(most, number);
  }
  // Logarithmic for a key that spans more than a decade.
  constexpr double decade = 10.0;
  return axis_of_values(measured.abscissa, values, !measured.is_against_time() && least > 0.0 && most > decade * least);
}

void draw_data(Page& page, const Part& part, const Box& box) {
  const Experiment& experiment = part.experiment;
  const std::size_t n = experiment.data.size();
  const double factor = experiment.measured.factor;
  std::vector<double> numbers;
  for (const double sign : {0.0, -1.0, 1.0}) {
    for (const Datum& datum : experiment.data) numbers.push_back((datum.value + sign * datum.deviation) / factor);
  }
  for (const double value : part.model) numbers.push_back(value / factor);
  const SweepAxis x = abscissa_axis(experiment),
                  y = axis_of_numbers(column_label(experiment.measured.header()), numbers);
  draw_sweep_frame(page, box, x, y, true);
  // One line for each frame of a contour, otherwise one for all data.
  std::map<std::string, PageLine> lines;
  for (std::size_t i = 0; i < n; ++i) {
    page.lines.push_back(
        {{box.at(x.places[i], y.places[n + i]), box.at(x.places[i], y.places[2 * n + i])}, 0.75, data_colour, false});
    page.areas.push_back(sweep_dot(box.at(x.places[i], y.places[i]), data_colour));
    PageLine& line = lines[experiment.measured.is_contour() ? experiment.data[i].at : ""];
    line.points.push_back(box.at(x.places[i], y.places[3 * n + i]));
  }
  for (auto& [frame, line] : lines) {
    std::ranges::stable_sort(line.points, {}, [](const PagePoint& point) { return point[0]; });
    line.width = 1.3;
    line.colour = model_colour;
    if (line.points.size() > 1) page.lines.push_back(line);
  }
  page.texts.push_back({gnuplot_literal(experiment.name), {box.right, box.top + 8.0}, 8.0, TextAnchor::right});
}

void draw_residuals(Page& page, const Part& part, const Box& box) {
  std::vector<double> numbers(part.residuals.begin(), part.residuals.end());
  // The axis always includes one standard deviation on either side.
  numbers.insert(numbers.end(), {-1.0, 0.0, 1.0});
  const SweepAxis x = abscissa_axis(part.experiment), y = axis_of_numbers("(data − model) / deviation", numbers);
  draw_sweep_frame(page, box, x, y, true);
  const std::size_t n = part.experiment.data.size();
  const double zero = y.places[n + 1];
  page.lines.push_back({{box.at(0.0, zero), box.at(1.0, zero)}, 1.0, model_colour, false});
  for (std::size_t i = 0; i < n; ++i) {
    page.areas.push_back(sweep_dot(box.at(x.places[i], y.places[i]), data_colour));
  }
}

}  // namespace

void draw_fit(const FitFile& fit, const FitResult& result, const PictureFile& picture) {
  SweepPanels panels(2 * fit.experiments.size());
  Index first = 0;
  for (std::size_t i = 0; i < fit.experiments.size(); ++i) {
    const Experiment& experiment = fit.experiments[i];
    const Index n = std::ssize(experiment.data);
    const Part part{experiment, result.minimum.model.segment(first, n), result.minimum.residuals.segment(first, n)};
    draw_data(panels.page, part, panels.box(2 * i));
    draw_residuals(panels.page, part, panels.box(2 * i + 1));
    first += n;
  }
  draw_page(panels.page, picture);
}

}  // namespace vehd
