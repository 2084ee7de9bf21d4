#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

/// A file that a script of gnuplot's reads, by a name that vehd has chosen: letters, digits, '-' and '.'.
struct GnuplotFile {
  std::string name;
  std::string bytes;
};

/// Draws a picture. Gnuplot works in a folder of its own, where the files are, so no name of a file or directory that a
/// user has chosen stands in a script.
/// @param script   continues gnuplot_terminal()
/// @param picture  replaced when it is complete
/// @throws InputError if gnuplot is missing or reports an error; OutputError if the picture cannot be written
void draw_with_gnuplot(const std::string& script, const PictureFile& picture,
                       const std::vector<GnuplotFile>& files = {});

/// The lines of a gnuplot script that open a picture.
std::string gnuplot_terminal(PictureFormat format, const PictureSize& size);

/// Any text as a gnuplot string with just these bytes. All but letters and blanks are written as octal numbers:
/// nothing in the text can end the string or start a command.
std::string gnuplot_quoted(const std::string& text);

/// Ticks of an axis, one text at each place, as `set xtics` takes them.
std::string gnuplot_ticks(const std::vector<std::string>& texts, const std::vector<double>& places);

/// A name as enhanced text that prints it as it is: without this, an underscore would lower the next letter. Control
/// characters become blanks.
std::string gnuplot_literal(const std::string& text);

}  // namespace vehd
