#include "bie/pictures/picture_format.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bie/pictures/gnuplot.hpp"

namespace vehd {

std::string_view name_of(PictureFormat format) { return picture_formats[static_cast<std::size_t>(format)]; }

std::optional<PictureFormat> format_of(const std::filesystem::path& file) {
  const std::string end = file.extension().string();
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::pdf, PictureFormat::svg}) {
    if (end == fmt::format(".{}", name_of(format))) return format;
  }
  return std::nullopt;
}

// What gnuplot makes of a font size and a line width differs by format; measured with gnuplot 5.4.
double gnuplot_font_size(PictureFormat format, double points, double pixels_per_point) {
  switch (format) {
    case PictureFormat::png:
      return 0.75 * points * pixels_per_point;
    case PictureFormat::pdf:
      return 1.5 * points;
    case PictureFormat::svg:
      return points;
  }
  return points;
}

double gnuplot_line_width(PictureFormat format, double points, double pixels_per_point) {
  switch (format) {
    case PictureFormat::png:
      return points * pixels_per_point;
    case PictureFormat::pdf:
      return 2.0 * points;
    case PictureFormat::svg:
      return points;
  }
  return points;
}

std::string gnuplot_terminal(const PictureFile& picture, const PictureSize& size) {
  const std::string font = fmt::format("enhanced font 'DejaVu Sans,{:.4g}' background rgb 'white'",
                                       gnuplot_font_size(picture.format, size.font, size.pixels_per_point));
  const std::string output = fmt::format("\nset output {}\n", gnuplot_quoted(picture.path.string()));
  switch (picture.format) {
    case PictureFormat::png:
      return fmt::format("set terminal pngcairo rounded size {},{} {}{}",
                         std::lround(size.width * size.pixels_per_point),
                         std::lround(size.height * size.pixels_per_point), font, output);
    case PictureFormat::pdf: {
      // Gnuplot cuts the size down to whole points.
      constexpr double points_per_inch = 72.0, more = 0.01;
      return fmt::format("set terminal pdfcairo rounded size {:.5f}in,{:.5f}in {}{}",
                         (size.width + more) / points_per_inch, (size.height + more) / points_per_inch, font, output);
    }
    case PictureFormat::svg:
      return fmt::format("set terminal svg standalone rounded size {:.0f},{:.0f} {}{}", size.width, size.height, font,
                         output);
  }
  return "";
}

}  // namespace vehd
