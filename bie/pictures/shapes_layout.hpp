#pragma once

#include <array>
#include <vector>

#include "bie/pictures/page.hpp"

namespace vehd {

/// Parts of a picture of shapes; lengths in points except those of shapes.
struct ShapesContent {
  /// Half width and half height of each shape about its middle, in units of the scene.
  std::vector<std::array<double, 2>> half_extents;
  double label_width = 0.0;           ///< of the widest text below a shape
  std::vector<double> key_heights{};  ///< of the items of the key
  double key_width = 0.0;             ///< of the widest of them
  double bar_width = 0.0;             ///< of the colour bar with its texts; 0: none
  double page_width = 510.0;          ///< largest width: both columns of a journal
};

/// Positions of all parts, which do not overlap.
struct ShapesLayout {
  double width = 0.0, height = 0.0;
  double scale = 1.0;             ///< points per length of the scene
  std::vector<Box> cells;         ///< of the shapes, row by row
  std::vector<PagePoint> labels;  ///< middle of the text below each shape
  std::vector<Box> key;           ///< of its items
  Box bar;                        ///< of the colour bar with its texts
};

/// Height of the line of text below a shape.
constexpr double shape_label_height = 16.0;

/// Layout in one to three rows with the key to the left or below, whichever shows the shapes largest.
ShapesLayout layout_of(const ShapesContent& content);

}  // namespace vehd
