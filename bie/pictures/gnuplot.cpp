#include "bie/pictures/gnuplot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <regex>
#include <string_view>

#include "bie/support/child_process.hpp"
#include "bie/support/errors.hpp"
#include "bie/support/file_system.hpp"

namespace vehd {

std::string_view name_of(PictureFormat format) { return picture_formats[static_cast<std::size_t>(format)]; }

std::optional<PictureFormat> format_of(const std::filesystem::path& file) {
  const std::string end = file.extension().string();
  for (const PictureFormat format : {PictureFormat::png, PictureFormat::pdf, PictureFormat::svg}) {
    if (end == fmt::format(".{}", name_of(format))) return format;
  }
  return std::nullopt;
}

// The meaning of font sizes and line widths depends on the format; measured with gnuplot 5.4.
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

namespace {

constexpr const char *script_name = "script", *messages_name = "messages", *picture_name = "picture";

bool is_letter_or_blank(char byte) {
  return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z') || byte == ' ';
}

/// Escapes &, which gnuplot 5.4 copies from a text into SVG.
std::string well_formed(const std::string& svg) {
  static const std::regex entity("^&(amp|lt|gt|quot|apos|#[0-9]+|#x[0-9a-fA-F]+);");
  constexpr std::size_t longest_entity = 10;
  std::string result;
  for (std::size_t at = 0; at < svg.size(); ++at) {
    result += svg[at];
    if (svg[at] == '&' && !std::regex_search(svg.substr(at, longest_entity), entity)) result += "amp;";
  }
  return result;
}

bool is_control_character(char byte) { return (byte >= 0 && byte < ' ') || byte == 0x7f; }

}  // namespace

void draw_with_gnuplot(const std::string& script, const PictureFile& picture, const std::vector<GnuplotFile>& files) {
  const TemporaryFolder folder("vehd-picture");
  for (const GnuplotFile& file : files) replace_file(folder.path() / file.name, file.bytes);
  replace_file(folder.path() / script_name, script);
  const std::filesystem::path messages = folder.path() / messages_name;
  const ChildEnd end = run_child({{"gnuplot", script_name}, messages, folder.path()});
  if (end.start_problem == ENOENT) {
    throw InputError("gnuplot is not installed; on Debian it is the package gnuplot-nox");
  }
  if (end.start_problem != 0) {
    throw InputError(fmt::format("gnuplot cannot be started: {}", std::strerror(end.start_problem)));
  }
  if (end.signal != 0 || end.exit_code != 0) {
    throw InputError(fmt::format("gnuplot failed: {}", text_of_file(messages)));
  }
  const std::string drawn = text_of_file(folder.path() / picture_name);
  replace_file(picture.path, picture.format == PictureFormat::svg ? well_formed(drawn) : drawn);
}

std::string gnuplot_terminal(PictureFormat format, const PictureSize& size) {
  const std::string font = fmt::format("enhanced font 'DejaVu Sans,{:.4g}' background rgb 'white'\nset output '{}'\n",
                                       gnuplot_font_size(format, size.font, size.pixels_per_point), picture_name);
  switch (format) {
    case PictureFormat::png:
      return fmt::format("set terminal pngcairo rounded size {},{} {}", std::lround(size.width * size.pixels_per_point),
                         std::lround(size.height * size.pixels_per_point), font);
    case PictureFormat::pdf: {
      // Gnuplot truncates the size to whole points.
      constexpr double points_per_inch = 72.0, more = 0.01;
      return fmt::format("set terminal pdfcairo rounded size {:.5f}in,{:.5f}in {}",
                         (size.width + more) / points_per_inch, (size.height + more) / points_per_inch, font);
    }
    case PictureFormat::svg:
      return fmt::format("set terminal svg standalone rounded size {:.0f},{:.0f} {}", size.width, size.height, font);
  }
  return "";
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "\"";
  // Digits too: gnuplot would read one after an octal number as part of it.
  for (const char byte : text) {
    quoted +=
        is_letter_or_blank(byte) ? std::string(1, byte) : fmt::format("\\{:03o}", static_cast<unsigned char>(byte));
  }
  return quoted + "\"";
}

std::string gnuplot_ticks(const std::vector<std::string>& texts, const std::vector<double>& places) {
  std::vector<std::string> ticks;
  for (std::size_t i = 0; i < places.size(); ++i) {
    ticks.push_back(fmt::format("{} {:.12g}", gnuplot_quoted(texts[i]), places[i]));
  }
  return fmt::format("({})", fmt::join(ticks, ", "));
}

std::string gnuplot_literal(const std::string& text) {
  constexpr std::string_view notation = "_^{}@&~\\";
  std::string literal;
  for (const char letter : text) {
    if (notation.find(letter) != std::string_view::npos) literal += '\\';
    literal += is_control_character(letter) ? ' ' : letter;
  }
  return literal;
}

}  // namespace vehd
