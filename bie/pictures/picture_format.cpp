#include "bie/pictures/picture_format.hpp"

#include <fmt/format.h>

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

}  // namespace vehd
