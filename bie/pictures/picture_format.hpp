#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vehd {

/// Kinds of picture files; PDF and SVG keep lines and letters as such.
enum class PictureFormat { png, pdf, svg };

/// Their names, which end the names of the files.
constexpr std::array<std::string_view, 3> picture_formats = {"png", "pdf", "svg"};

/// "png", "pdf" or "svg".
std::string_view name_of(PictureFormat format);

/// Format by the extension of a file; nullopt if it is none of them.
std::optional<PictureFormat> format_of(const std::filesystem::path& file);

/// Where a picture goes.
struct PictureFile {
  std::filesystem::path path;
  PictureFormat format = PictureFormat::png;
};

/// Size of a picture in points (1/72 inch) and of its letters.
struct PictureSize {
  double width = 0.0, height = 0.0;
  double font = 8.0;
  double pixels_per_point = 4.0;  ///< of PNG
};

/// Width of a line in points as gnuplot wants it for this format.
double gnuplot_line_width(PictureFormat format, double points, double pixels_per_point);

/// A font size in points as gnuplot wants it for this format.
double gnuplot_font_size(PictureFormat format, double points, double pixels_per_point);

}  // namespace vehd
