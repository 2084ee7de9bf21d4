#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace vehd {

/// A scene that comes with the program: the text of docs/scenes/NAME.toml.
struct ShippedScene {
  std::string_view name;
  std::string_view text;
};

/// All of docs/scenes as they were when the program was built, in the order of their names.
const std::vector<ShippedScene>& shipped_scenes();

/// Description of a scene: the first sentence of its first comment.
std::string title_of(const ShippedScene& scene);

}  // namespace vehd
