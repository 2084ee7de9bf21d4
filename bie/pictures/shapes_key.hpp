#pragma once

#include <vector>

#include "bie/pictures/page.hpp"
#include "bie/pictures/shown_numbers.hpp"
#include "bie/scene/scene.hpp"
#include "bie/support/types.hpp"

/// Key beside the shapes: the axes, arrows of field, gravity and flow, and a scale bar.
namespace vehd {

enum class KeyItem { axes, field, gravity, flow, scale_bar };

/// The items of a scene, in order.
std::vector<KeyItem> key_items(const Scene& scene);

/// Height of an item, in points.
double key_height(KeyItem item);
constexpr double key_width = 60.0;

/// Input of all items.
struct KeyTask {
  const Scene& scene;
  Matrix3 view;      ///< rows: right, up, towards the eye
  double scale;      ///< points per length of the scene
  ShownUnit length;  ///< of the scale bar
};

/// Draws one item within its box.
void draw_key_item(Page& page, KeyItem item, const Box& box, const KeyTask& task);

}  // namespace vehd
