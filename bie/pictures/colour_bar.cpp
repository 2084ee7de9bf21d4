#include "bie/pictures/colour_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/pictures/shown_numbers.hpp"

namespace vehd {
namespace {

constexpr double bar_width = 9.0, tick_length = 3.0, text_size = 7.5, title_size = 8.0, title_line = 12.0;
/// Height of the triangles at the ends, which stand for all values beyond them.
constexpr double end_height = 7.0;

Image gradient(const ColourMap& colours, int height) {
  // Gnuplot does not draw images of a single column.
  constexpr int width = 2;
  Image image{width, height, {}};
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      for (const double component : colours.at(1.0 - (row + 0.5) / height)) {
        image.rgb.push_back(static_cast<std::uint8_t>(std::lround(255.0 * component)));
      }
    }
  }
  return image;
}

}  // namespace

ColourBar colour_bar(const ColourRange& range, const std::string& name, const std::string& unit) {
  ColourBar bar{range, round_ticks(range.lower, range.upper), {}, {name}};
  int power = 0;
  bar.texts = tick_texts(bar.ticks, power);
  if (power != 0) bar.title.push_back(fmt::format("(10^{{{}}}{}{})", power, unit.empty() ? "" : " ", unit));
  if (power == 0 && !unit.empty()) bar.title.push_back(fmt::format("({})", unit));
  return bar;
}

double width_of(const ColourBar& bar) {
  double width = 0.0;
  for (const std::string& text : bar.texts) {
    width = std::max(width, bar_width + tick_length + 2.0 + text_size * text_width(text));
  }
  for (const std::string& line : bar.title) width = std::max(width, title_size * text_width(line));
  return width;
}

void draw_colour_bar(Page& page, const ColourBar& bar, const ColourMap& colours, const Box& box) {
  double top = box.top;
  for (const std::string& line : bar.title) {
    page.texts.push_back({line, {box.left, top - 0.5 * title_line}, title_size, TextAnchor::left, "#000000"});
    top -= title_line;
  }
  // Room for half a line of text or for a triangle at either end.
  const double lower = box.bottom + end_height, upper = top - end_height;
  const double left = box.left, right = box.left + bar_width;
  page.images.push_back({gradient(colours, 256), {left, lower, right, upper}});
  page.lines.push_back(frame_of({left, lower, right, upper}, 0.4, "#444444"));
  const double middle = 0.5 * (left + right);
  if (bar.range.below) {
    page.areas.push_back({{{left, lower}, {right, lower}, {middle, lower - end_height}}, hex_of(colours.at(0.0))});
  }
  if (bar.range.above) {
    page.areas.push_back({{{left, upper}, {right, upper}, {middle, upper + end_height}}, hex_of(colours.at(1.0))});
  }
  for (std::size_t i = 0; i < bar.ticks.size(); ++i) {
    const double share = (bar.ticks[i] - bar.range.lower) / (bar.range.upper - bar.range.lower);
    const double y = lower + share * (upper - lower);
    page.lines.push_back({{{right, y}, {right + tick_length, y}}, 0.5, "#000000", false});
    page.texts.push_back({bar.texts[i], {right + tick_length + 2.0, y}, text_size, TextAnchor::left, "#000000"});
  }
}

}  // namespace vehd
