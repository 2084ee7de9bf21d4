#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vehd {

/// Formats of pictures; PDF and SVG keep lines and letters as vectors.
enum class PictureFormat { png, pdf, svg };

/// Names of the formats, which are also the extensions of their files.
constexpr std::array<std::string_view, 3> picture_formats = {"png", "pdf", "svg"};

/// "png", "pdf" or "svg".
std::string_view name_of(PictureFormat format);

/// Format that the extension of a file stands for; nullopt if there is none.
std::optional<PictureFormat> format_of(const std::filesystem::path& file);

/// Destination of a picture.
struct PictureFile {
  std::filesystem::path path;
  PictureFormat format = PictureFormat::png;
};

/// Size of a picture in points (1/72 inch), and of its letters.
struct PictureSize {
  double width = 0.0, height = 0.0;
  double font = 8.0;
  double pixels_per_point = 4.0;  ///< of PNG
};

/// Width of a line in points, as a number that gnuplot takes for this format.
double gnuplot_line_width(PictureFormat format, double points, double pixels_per_point);

/// A font size in points, as a number that gnuplot takes for this format.
double gnuplot_font_size(PictureFormat format, double points, double pixels_per_point);

/// A file that a gnuplot script reads, with a name chosen by vehd: letters, digits, '-' and '.'.
struct GnuplotFile {
  std::string name;
  std::string bytes;
};

/// Draws a picture. Gnuplot runs in a temporary folder that has these files, so that no name of a file or directory
/// chosen by a user occurs in a script.
/// @param script   begins with gnuplot_terminal()
/// @param picture  replaced once it is complete
/// @throws InputError if gnuplot is missing or reports an error; OutputError if the picture cannot be written
void draw_with_gnuplot(const std::string& script, const PictureFile& picture,
                       const std::vector<GnuplotFile>& files = {});

/// The lines of a gnuplot script that begin a picture.
std::string gnuplot_terminal(PictureFormat format, const PictureSize& size);

/// Any text as a gnuplot string of exactly these bytes. All except letters and blanks are written as octal numbers, so
/// that nothing in the text can end the string or start a command.
std::string gnuplot_quoted(const std::string& text);

/// Ticks of an axis in the syntax of `set xtics`, one text for each place.
std::string gnuplot_ticks(const std::vector<std::string>& texts, const std::vector<double>& places);

/// A name as enhanced text that prints unchanged: otherwise an underscore would lower the next letter. Control
/// characters become blanks.
std::string gnuplot_literal(const std::string& text);

}  // namespace vehd
