#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "bie/pictures/gnuplot.hpp"
#include "bie/pictures/renderer.hpp"

/// A picture whose parts all have known positions, in points (1/72 inch) from the lower left corner.
namespace vehd {

using PagePoint = std::array<double, 2>;

/// Sides of an upright rectangle.
struct Box {
  double left = 0.0, bottom = 0.0, right = 0.0, top = 0.0;

  [[nodiscard]] double width() const { return right - left; }
  [[nodiscard]] double height() const { return top - bottom; }
  [[nodiscard]] bool meets(const Box& other) const {
    return left < other.right && other.left < right && bottom < other.top && other.bottom < top;
  }
  [[nodiscard]] bool holds(const Box& other) const {
    return left <= other.left && other.right <= right && bottom <= other.bottom && other.top <= top;
  }
  /// The point at these fractions of the width and of the height.
  [[nodiscard]] PagePoint at(double across, double up) const {
    return {left + across * width(), bottom + up * height()};
  }
  /// Anticlockwise from the lower left.
  [[nodiscard]] std::vector<PagePoint> corners() const {
    return {{left, bottom}, {right, bottom}, {right, top}, {left, top}};
  }
};

enum class TextAnchor { left, centre, right };

/// One line, in gnuplot's enhanced notation (a_m, 10^{-3}); y is its middle.
struct PageText {
  std::string text;
  PagePoint at{};
  double size = 8.0;  ///< of the font
  TextAnchor anchor = TextAnchor::left;
  std::string colour = "#000000";
};

/// A polyline, with an arrow head at its end or not.
struct PageLine {
  std::vector<PagePoint> points;
  double width = 0.75;
  std::string colour = "#000000";
  bool head = false;
};

/// A filled polygon.
struct PageArea {
  std::vector<PagePoint> points;
  std::string colour;
};

struct PageImage {
  Image image;
  Box box;
};

struct Page {
  double width = 0.0, height = 0.0;
  std::vector<PageImage> images{};
  std::vector<PageArea> areas{};
  std::vector<PageLine> lines{};
  std::vector<PageText> texts{};
};

/// The outline of a box.
PageLine frame_of(const Box& box, double width, const std::string& colour);

/// Upper bound of the width of a line of text in the font of the pictures (DejaVu Sans), in units of the font size.
double text_width(std::string_view enhanced);

/// Box that a text occupies.
Box box_of(const PageText& text);

/// Pixels per point, for images in every format and for the whole picture as PNG.
constexpr double page_pixels = 4.0;

/// Draws the page through gnuplot.
/// @throws InputError if gnuplot is missing or reports an error
void draw_page(const Page& page, const PictureFile& picture);

}  // namespace vehd
