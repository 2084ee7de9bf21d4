#include "bie/pictures/page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bie/pictures/gnuplot.hpp"

namespace vehd {
namespace {

/// Height of a line of text with its indices, in units of the font size.
constexpr double line_height = 1.5;

/// RGB for gnuplot, rows from the bottom.
std::string raw_bytes(const Image& image) {
  std::string bytes;
  bytes.reserve(image.rgb.size());
  for (int row = image.height - 1; row >= 0; --row) {
    const auto begin = image.rgb.begin() + std::ptrdiff_t{row} * image.width * 3;
    bytes.append(begin, begin + std::ptrdiff_t{image.width} * 3);
  }
  return bytes;
}

/// Width of a character in units of the font size, estimated from above.
double character_width(char32_t character) {
  constexpr std::u32string_view narrow = U"ijl.,:;'|!()[] ftI/-", wide = U"mwMW@%\u2212\u00d7=+QOG";
  if (narrow.find(character) != std::u32string_view::npos) return 0.42;
  if (wide.find(character) != std::u32string_view::npos) return 0.99;
  return character < 0x80 && std::islower(static_cast<int>(character)) != 0 ? 0.64 : 0.72;
}

std::string line_script(const PageLine& line, int tag, PictureFormat format) {
  std::string script;
  const double width = gnuplot_line_width(format, line.width, page_pixels);
  for (std::size_t i = 0; i + 1 < line.points.size(); ++i) {
    const bool last = i + 2 == line.points.size();
    script += fmt::format("set arrow {} from {:.3f},{:.3f} to {:.3f},{:.3f} {} front lw {:.3f} lc rgb '{}'\n",
                          tag + static_cast<int>(i), line.points[i][0], line.points[i][1], line.points[i + 1][0],
                          line.points[i + 1][1], line.head && last ? "head filled size first 5,18" : "nohead", width,
                          line.colour);
  }
  return script;
}

std::string text_script(const PageText& text, PictureFormat format) {
  constexpr std::array anchors{"left", "center", "right"};
  return fmt::format("set label {} at {:.3f},{:.3f} {} front font ',{:.4g}' textcolor rgb '{}'\n",
                     gnuplot_quoted(text.text), text.at[0], text.at[1], anchors[static_cast<std::size_t>(text.anchor)],
                     gnuplot_font_size(format, text.size, page_pixels), text.colour);
}

std::string area_script(const PageArea& area) {
  std::string script = "set object polygon";
  for (std::size_t i = 0; i <= area.points.size(); ++i) {
    const PagePoint& point = area.points[i % area.points.size()];
    script += fmt::format(" {} {:.3f},{:.3f}", i == 0 ? "from" : "to", point[0], point[1]);
  }
  return script + fmt::format(" front fillstyle solid noborder fillcolor rgb '{}'\n", area.colour);
}

}  // namespace

PageLine frame_of(const Box& box, double width, const std::string& colour) {
  PageLine frame{box.corners(), width, colour, false};
  frame.points.push_back(frame.points.front());
  return frame;
}

double text_width(std::string_view enhanced) {
  double width = 0.0;
  bool is_literal = false;
  for (std::size_t i = 0; i < enhanced.size();) {
    const auto first = static_cast<unsigned char>(enhanced[i]);
    const int length = first < 0x80 ? 1 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : 4;
    char32_t character = length == 1 ? first : first & (0xff >> (length + 1));
    for (int k = 1; k < length && i + k < enhanced.size(); ++k) {
      character = (character << 6) | (static_cast<unsigned char>(enhanced[i + k]) & 0x3f);
    }
    i += static_cast<std::size_t>(length);
    // Unescaped marks of the notation take no room; text that they lower or raise is smaller but counted in full.
    constexpr std::u32string_view marks = U"_^{}\\";
    const bool is_mark = !is_literal && marks.find(character) != std::u32string_view::npos;
    is_literal = is_mark && character == U'\\';
    if (is_mark) continue;
    width += character_width(character);
  }
  return width;
}

Box box_of(const PageText& text) {
  const double width = text.size * text_width(text.text), half_height = 0.5 * line_height * text.size;
  const double left = text.at[0] - (text.anchor == TextAnchor::left     ? 0.0
                                    : text.anchor == TextAnchor::centre ? 0.5 * width
                                                                        : width);
  return {left, text.at[1] - half_height, left + width, text.at[1] + half_height};
}

void draw_page(const Page& page, const PictureFile& picture) {
  std::string script = gnuplot_terminal(picture.format, {page.width, page.height, 8.0, page_pixels});
  script += fmt::format(
      "unset border; unset tics; unset key\n"
      "set lmargin at screen 0; set rmargin at screen 1; set bmargin at screen 0; set tmargin at screen 1\n"
      "set xrange [0:{}]; set yrange [0:{}]\n",
      page.width, page.height);
  for (const PageArea& area : page.areas) script += area_script(area);
  int tag = 1;
  for (const PageLine& line : page.lines) {
    script += line_script(line, tag, picture.format);
    tag += static_cast<int>(line.points.size());
  }
  for (const PageText& text : page.texts) script += text_script(text, picture.format);
  std::vector<GnuplotFile> files;
  std::string plot = "plot ";
  for (const PageImage& item : page.images) {
    files.push_back({fmt::format("image-{}.rgb", files.size()), raw_bytes(item.image)});
    const double dx = item.box.width() / item.image.width, dy = item.box.height() / item.image.height;
    plot += fmt::format(
        "'{}' binary array=({},{}) dx={:.9g} dy={:.9g} origin=({:.9g},{:.9g}) format='%uchar' using 1:2:3 with "
        "rgbimage, ",
        files.back().name, item.image.width, item.image.height, dx, dy, item.box.left + 0.5 * dx,
        item.box.bottom + 0.5 * dy);
  }
  draw_with_gnuplot(script + plot + "NaN notitle\n", picture, files);
}

}  // namespace vehd
